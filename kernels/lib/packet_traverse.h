/* One packet through the lower level: layout wide8_single. OpenCL C only. */
#ifndef MACULA_LIB_PACKET_TRAVERSE_H
#define MACULA_LIB_PACKET_TRAVERSE_H

#include "lib/packet_frustum.h"
#include "lib/packet_triangle.h"
#include "lib/wide_stack.h"

/* The planes of a box as the lanes of a packet of one octant test them. Far planes are moved away
 * by more than twice what a lane pads, so that no lane's own far planes are needed to cull no box
 * that the lane enters. */
typedef struct BoxPlanes {
    float near[3], far[3];
} BoxPlanes;

static inline BoxPlanes box_planes(global const Wide8Node* node, uint i, uint octant,
                                   float margin) {
    BoxPlanes box;
    for (uint axis = 0u; axis < 3u; ++axis) {
        const uint side = (octant >> axis) & 1u;
        const float pad = 2.0f * margin;
        box.near[axis] = node->plane[axis][side][i];
        box.far[axis] = node->plane[axis][side ^ 1u][i] + (side != 0u ? -pad : pad);
    }
    return box;
}

/* True when some lane may enter the box no later than its t_max. */
static inline bool may_enter(const Packet* p, float t_min, const BoxPlanes* box) {
    const float16 near =
        m_max(m_max(fma((float16)(box->near[0]), p->r[0], p->n[0]),
                    fma((float16)(box->near[1]), p->r[1], p->n[1])),
              m_max(fma((float16)(box->near[2]), p->r[2], p->n[2]), (float16)(t_min)));
    const float16 far = m_min(m_min(fma((float16)(box->far[0]), p->r[0], p->n[0]),
                                    fma((float16)(box->far[1]), p->r[1], p->n[1])),
                              fma((float16)(box->far[2]), p->r[2], p->n[2]));
    return any_lane16(near <= m_min(far * MACULA_FRUSTUM_GROW, p->t_max));
}

/* The same for lanes of several octants. */
static inline bool may_enter_mixed(const Packet* p, global const Wide8Node* node, uint i) {
    const float pad = 2.0f * p->margin;
    float16 near = p->t_min, far = p->t_max;
    for (uint axis = 0u; axis < 3u; ++axis) {
        const float lo = node->plane[axis][0][i], hi = node->plane[axis][1][i];
        const int16 negative = p->r[axis] < 0.0f;
        const float16 entry = negative ? (float16)(hi) : (float16)(lo);
        const float16 exit = negative ? (float16)(lo - pad) : (float16)(hi + pad);
        near = m_max(near, fma(entry, p->r[axis], p->n[axis]));
        far = m_min(far, fma(exit, p->r[axis], p->n[axis]) * MACULA_FRUSTUM_GROW);
    }
    return any_lane16(near <= far);
}

static inline uint push_children16(const TraceScene* scene, const Packet* p, const Frustum* f,
                                   global const Wide8Node* node, WideStack* stack, uint depth) {
    const WidePlanes planes = load_planes(node, p->frustum_octant);
    float8 near;
    ulong lanes = lane_mask8(enter_frustum8(f, p->mixed, &planes, &near));
    const uint base = depth;
    while (lanes != 0ul) {
        const uint i = first_lane8(lanes);
        lanes = without_lane8(lanes, i);
        const BoxPlanes box = box_planes(node, i, p->octant, p->margin);
        if (p->mixed ? may_enter_mixed(p, node, i) : may_enter(p, f->t_min, &box)) {
            fetch_child_single(scene, node->child[i]);
            depth = push_child(stack, base, depth, node->child[i], ((const float*)&near)[i]);
        }
    }
    return depth;
}

/* Tightens the bound for culling after hits; negative when all lanes are done. */
static inline void bound_t_max(Frustum* f, const Packet* p) {
    const float t_max = greatest_lane16(p->t_max);
    f->t_max = MACULA_ANY_HIT && t_max >= 0.0f ? f->t_max : t_max;
}

static inline void traverse_packet(const TraceScene* scene, const PacketInstance* instance,
                                   Packet* p, const PacketBounds* bounds, PacketHit* best,
                                   int root) {
    global const Wide8Node* nodes = (global const Wide8Node*)scene->nodes;
    Frustum f = make_frustum(bounds);
    WideStack stack;
    uint depth = push_child(&stack, 0u, 0u, root, 0.0f);
    while (depth != 0u) {
        const int node = stack.child[--depth];
#if !MACULA_ANY_HIT
        if (stack.near[depth] > f.t_max)
            continue;
#endif
        if (node >= 0) {
            depth = push_children16(scene, p, &f, nodes + node, &stack, depth);
        } else if (test_leaf16(scene, instance, p, best, node)) {
            bound_t_max(&f, p);
            if (f.t_max < 0.0f)
                return;
        }
    }
}

#endif
