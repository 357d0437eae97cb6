/* Many rays a work-item, for CPUs: rays that have little in common are sorted by octant and traced
 * in chunks of up to 32 that share the loads of nodes (after Tsakok 2009, "Faster Incoherent Rays:
 * Multi-BVH Ray Stream Tracing"). */
#include "lib/wide_stream_scene.h"

/* The octants, and the rays that are not active. */
#define INACTIVE 8u
#define BINS 9u

/* The rays of a work-item sorted into bins; within a bin they keep their order. */
typedef struct RayOrder {
    ushort ray[MACULA_RAYS_PER_ITEM];
    uint begin[BINS + 1u];
} RayOrder;

static inline uint bin_of(global const RayBlock* rays, uint i) {
    global const RayBlock* block = rays + i / MACULA_RAY_BLOCK;
    const uint lane = i % MACULA_RAY_BLOCK;
    return !ray_is_active(block->t_min[lane], block->t_max[lane])
               ? INACTIVE
               : (block->direction_x[lane] < 0.0f ? 1u : 0u) |
                     (block->direction_y[lane] < 0.0f ? 2u : 0u) |
                     (block->direction_z[lane] < 0.0f ? 4u : 0u);
}

/* A counting sort. */
static inline void sort_rays(global const RayBlock* rays, uint first, uint count, RayOrder* order) {
    uchar bin[MACULA_RAYS_PER_ITEM];
    uint next[BINS];
    for (uint b = 0u; b < BINS; ++b)
        next[b] = 0u;
    for (uint i = 0u; i < count; ++i) {
        bin[i] = (uchar)bin_of(rays, first + i);
        ++next[bin[i]];
    }
    uint sum = 0u;
    for (uint b = 0u; b < BINS; ++b) {
        order->begin[b] = sum;
        sum += next[b];
        next[b] = order->begin[b];
    }
    order->begin[BINS] = sum;
    for (uint i = 0u; i < count; ++i)
        order->ray[next[bin[i]]++] = (ushort)i;
}

static inline void store_misses(global const RayBlock* rays, uint first, const RayOrder* order,
                                global uint* results) {
    for (uint i = order->begin[INACTIVE]; i < order->begin[BINS]; ++i) {
        const uint ray = first + order->ray[i];
        const TraceHit miss = no_hit(rays[ray / MACULA_RAY_BLOCK].t_max[ray % MACULA_RAY_BLOCK]);
        store_result(results, ray, &miss);
    }
}

kernel void trace(TRACE_ARGUMENTS) {
    const uint first = (uint)get_global_id(0) * MACULA_RAYS_PER_ITEM;
    if (first >= *ray_count)
        return;
    const TraceScene scene = {nodes,
                              triangles,
                              instances,
                              upper_nodes,
                              {mask_slots, mask_triangles, mask_textures, mask_words}};
    const uint rest = *ray_count - first;
    RayOrder order;
    sort_rays(rays, first, rest < MACULA_RAYS_PER_ITEM ? rest : MACULA_RAYS_PER_ITEM, &order);
    for (uint octant = 0u; octant < INACTIVE; ++octant)
        for (uint i = order.begin[octant]; i < order.begin[octant + 1u]; i += MACULA_CHUNK) {
            const uint left = order.begin[octant + 1u] - i;
            trace_chunk(&scene, rays, first, order.ray + i,
                        left < MACULA_CHUNK ? left : MACULA_CHUNK, octant, results);
        }
    store_misses(rays, first, &order, results);
}
