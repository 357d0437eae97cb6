/* The one contract of every traversal variant (docs/variants.md).
 *
 * A variant is one file kernels/traverse/<name>.cl that defines
 * `kernel void trace(TRACE_ARGUMENTS)` and one entry of the manifest in host/kernel/variants.cpp.
 * The program is built once for each query kind: MACULA_ANY_HIT is 0 (closest hit: results are
 * HitBlocks) or 1 (any hit: results are one uint a ray, 1 = occluded). MACULA_INSTANCES is 0 when
 * the scene is one identity instance (the upper level is skipped) and MACULA_MASKS is 0 when no
 * triangle has an alpha mask.
 *
 * `ray_count` lives on the device. A launch covers the queue's capacity; work beyond the count
 * returns at once. Results of the rays up to the count are written, every one of them. */
#ifndef MACULA_LIB_TRACE_CONTRACT_H
#define MACULA_LIB_TRACE_CONTRACT_H

#include "shared/bvh.h"
#include "shared/mask.h"
#include "shared/ray.h"

#define TRACE_ARGUMENTS                                                                            \
    global const uchar *restrict nodes, global const uchar *restrict triangles,                    \
        global const Instance *restrict instances, global const BinaryNode *restrict upper_nodes,  \
        global const uint *restrict mask_slots,                                                    \
        global const MaskTriangle *restrict mask_triangles,                                        \
        global const MaskTexture *restrict mask_textures, global const uint *restrict mask_words,  \
        global const RayBlock *restrict rays, global const uint *restrict ray_count,               \
        global uint *restrict results, global uint *restrict work_counter

/* mask_slots[mesh_triangle + id]: index into mask_triangles, read only where MACULA_MASKED_BIT is
 * set. work_counter: one uint, 0 at launch, for variants that fetch work. */

/* The first ray of a work-item that traces `per_item` rays of `count`, of a launch over the queue's
 * capacity. Runtimes of CPUs hand out neighbouring work-items by the hundred: a short list must not
 * all go to one core, so it is spread over the launch. */
static inline uint first_of_spread(uint count, uint per_item) {
    const uint id = (uint)get_global_id(0), items = (count + per_item - 1u) / per_item;
    const uint apart = max((uint)get_global_size(0) / max(items, 1u), 1u);
    return id % apart == 0u ? id / apart * per_item : count;
}

#endif
