/* One ray a work-item through quantised 8-wide nodes: after Ylitie, Karras and Laine 2017,
 * "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs". A node is 96 bytes;
 * children lie in slots by the corner of the node that they are nearest to, so that visiting slots
 * in the order of the ray's octant is roughly front to back without sorting (section 3.3); a stack
 * entry is a node with the mask of its children still to visit, one for each level at most. */
#include "lib/traverse_query.h"
#include "lib/traverse_wide8.h"

/* Eight planes on the node's grid: the expression by which the builder made the boxes contain
 * what they bound. */
static inline float8 grid_planes(global const uchar* q, float scale, float origin) {
    return fma(convert_float8(vload8(0, q)), (float8)(scale), (float8)(origin));
}

/* Bit s ^ octant of a mask of slots moves to bit s, and back. */
static inline uint order_by_octant(uint mask, uint octant) {
    mask = (octant & 1u) != 0u ? ((mask & 0xaau) >> 1) | ((mask & 0x55u) << 1) : mask;
    mask = (octant & 2u) != 0u ? ((mask & 0xccu) >> 2) | ((mask & 0x33u) << 2) : mask;
    return (octant & 4u) != 0u ? ((mask & 0xf0u) >> 4) | ((mask & 0x0fu) << 4) : mask;
}

/* The children that the ray enters, one bit each, the first to visit lowest. */
static inline uint enter_quantized(global const Quantized8Node* node, const TraceRay* r) {
    const uint exponent = node->exponent;
    const float sx = as_float((exponent & 0xffu) << 23);
    const float sy = as_float(((exponent >> 8) & 0xffu) << 23);
    const float sz = as_float(((exponent >> 16) & 0xffu) << 23);
    const bool x = (r->octant & 1u) != 0u, y = (r->octant & 2u) != 0u, z = (r->octant & 4u) != 0u;
    float8 near, far;
    box_interval8(r, grid_planes(x ? node->hi[0] : node->lo[0], sx, node->origin[0]),
                  grid_planes(y ? node->hi[1] : node->lo[1], sy, node->origin[1]),
                  grid_planes(z ? node->hi[2] : node->lo[2], sz, node->origin[2]),
                  grid_planes(x ? node->lo[0] : node->hi[0], sx, node->origin[0]),
                  grid_planes(y ? node->lo[1] : node->hi[1], sy, node->origin[1]),
                  grid_planes(z ? node->lo[2] : node->hi[2], sz, node->origin[2]), &near, &far);
    const int8 entered = near <= m_min8(far, (float8)(r->t_max));
    const int8 bit = entered & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
    const int4 bit4 = bit.lo | bit.hi;
    const int2 bit2 = bit4.lo | bit4.hi;
    return order_by_octant((uint)(bit2.x | bit2.y) & (exponent >> 24), r->octant);
}

static inline bool traverse_lower(const TraceScene* scene, TraceQuery* query, int root) {
    global const Quantized8Node* nodes = (global const Quantized8Node*)scene->nodes;
    uint stack_node[MACULA_MAX_DEPTH];
    uchar stack_mask[MACULA_MAX_DEPTH];
    uint depth = 0u;
    uint node = (uint)root;
    uint mask = enter_quantized(nodes + node, &query->ray);
    for (;;) {
        while (mask == 0u) {
            if (depth == 0u)
                return false;
            --depth;
            node = stack_node[depth];
            mask = stack_mask[depth];
        }
        const uint slot = (31u - (uint)clz(mask & (~mask + 1u))) ^ query->ray.octant;
        mask &= mask - 1u;
        const int child = nodes[node].child[slot];
        if (child < 0) {
            if (test_leaf(scene, query, child))
                return true;
            continue;
        }
        if (mask != 0u) {
            stack_node[depth] = node;
            stack_mask[depth] = (uchar)mask;
            ++depth;
        }
        node = (uint)child;
        mask = enter_quantized(nodes + node, &query->ray);
    }
}

#include "lib/traverse_one_ray.h"
