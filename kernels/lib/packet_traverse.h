/* One packet through the lower level: layout wide8_single. OpenCL C only. */
#ifndef MACULA_LIB_PACKET_TRAVERSE_H
#define MACULA_LIB_PACKET_TRAVERSE_H

#include "lib/packet_frustum.h"
#include "lib/wide_stack.h"
#include "lib/packet_triangle.h"

static inline bool some_lane_enters(const Packet *p, global const Wide8Node *node, uint i) {
    const uint sx = p->octant & 1u, sy = (p->octant >> 1) & 1u, sz = p->octant >> 2;
    const int16 enters =
        p->mixed ? enter_box16(p, node->plane[0][0][i], node->plane[1][0][i], node->plane[2][0][i],
                               node->plane[0][1][i], node->plane[1][1][i], node->plane[2][1][i])
                 : enter_planes16(p, node->plane[0][sx][i], node->plane[1][sy][i],
                                  node->plane[2][sz][i], node->plane[0][sx ^ 1u][i],
                                  node->plane[1][sy ^ 1u][i], node->plane[2][sz ^ 1u][i]);
    return any_lane16(enters);
}

static inline void push_children16(const TraceScene *scene, const Packet *p, const Frustum *f,
                                   global const Wide8Node *node, WideStack *stack) {
    const WidePlanes planes = load_planes(node, f->octant);
    float8 near;
    ulong lanes = lane_mask8(enter_frustum8(f, &planes, &near));
    const uint base = stack->depth;
    while (lanes != 0ul) {
        const uint i = first_lane8(lanes);
        lanes = without_lane8(lanes, i);
        if (some_lane_enters(p, node, i)) {
            fetch_child_single(scene, node->child[i]);
            push_child(stack, base, node->child[i], ((const float *)&near)[i]);
        }
    }
}

static inline void traverse_packet(const TraceScene *scene, const PacketInstance *instance,
                                   Packet *p, PacketHit *best, int root) {
    global const Wide8Node *nodes = (global const Wide8Node *)scene->nodes;
    Frustum f = make_frustum(p);
    WideStack stack;
    stack.depth = 0u;
    push_child(&stack, 0u, root, 0.0f);
    while (stack.depth != 0u) {
        const int node = stack.child[--stack.depth];
#if !MACULA_ANY_HIT
        if (stack.near[stack.depth] > f.t_max)
            continue;
#endif
        if (node >= 0) {
            push_children16(scene, p, &f, nodes + node, &stack);
        } else if (test_leaf16(scene, instance, p, best, node)) {
            bound_t_max(&f, p);
            if (f.t_max < 0.0f)
                return;
        }
    }
}

#endif
