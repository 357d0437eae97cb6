/* Up to 32 packets whose frusta have one octant through the lower level in one traversal: a node
 * is loaded once for all packets that reach it. Layout wide8_single. OpenCL C only. */
#ifndef MACULA_LIB_PACKET_STREAM_H
#define MACULA_LIB_PACKET_STREAM_H

#include "lib/packet_frustum.h"
#include "lib/packet_triangle.h"
#include "lib/wide_stack.h"

#define MACULA_PACKETS (MACULA_RAYS_PER_ITEM / 16)

typedef struct PacketStream {
    Packet packet[MACULA_PACKETS];
    PacketHit best[MACULA_PACKETS];
    Frustum frustum[MACULA_PACKETS];
} PacketStream;

/* Bit k of a packet mask stands for packet k of the stream. */
typedef struct PacketStreamStack {
    int child[MACULA_WIDE_STACK];
    uint packets[MACULA_WIDE_STACK];
    float near[MACULA_WIDE_STACK];
    uint depth;
} PacketStreamStack;

static inline uint first_bit(uint mask) { return 31u - (uint)clz(mask & (~mask + 1u)); }

static inline void push_packets(PacketStreamStack *stack, uint base, int child, uint packets,
                                float near) {
    uint i = stack->depth++;
    for (; i > base && stack->near[i - 1u] < near; --i) {
        stack->near[i] = stack->near[i - 1u];
        stack->child[i] = stack->child[i - 1u];
        stack->packets[i] = stack->packets[i - 1u];
    }
    stack->near[i] = near;
    stack->child[i] = child;
    stack->packets[i] = packets;
}

static inline void visit_node(const TraceScene *scene, const PacketStream *stream, global const Wide8Node *node,
                              uint packets, uint octant, PacketStreamStack *stack) {
    const WidePlanes planes = load_planes(node, octant);
    int8 found = 0;
    float8 nearest = MACULA_EMPTY;
    do {
        const uint k = first_bit(packets);
        packets &= packets - 1u;
        float8 near;
        const int8 enters = enter_frustum8(stream->frustum + k, &planes, &near);
        found |= enters & (int8)((int)(1u << k));
        nearest = enters ? m_min8(nearest, near) : nearest;
    } while (packets != 0u);
    ulong lanes = lane_mask8(found != 0);
    const uint base = stack->depth;
    while (lanes != 0ul) {
        const uint i = first_lane8(lanes);
        lanes = without_lane8(lanes, i);
        fetch_child_single(scene, node->child[i]);
        push_packets(stack, base, node->child[i], ((const uint *)&found)[i],
                     ((const float *)&nearest)[i]);
    }
}

/* The packets with a lane that may still find something closer than `near`. */
static inline uint packets_beyond(const PacketStream *stream, uint packets, float near) {
    uint kept = 0u;
    for (; packets != 0u; packets &= packets - 1u) {
        const uint k = first_bit(packets);
        kept |= near <= stream->frustum[k].t_max ? 1u << k : 0u;
    }
    return kept;
}

static inline void test_leaf_of_packets(const TraceScene *scene, const PacketInstance *instance,
                                        PacketStream *stream, int leaf, uint packets) {
    for (; packets != 0u; packets &= packets - 1u) {
        const uint k = first_bit(packets);
        if (test_leaf16(scene, instance, stream->packet + k, stream->best + k, leaf))
            bound_t_max(stream->frustum + k, stream->packet + k);
    }
}

static inline void traverse_packets(const TraceScene *scene, const PacketInstance *instance,
                                    PacketStream *stream, int root, uint packets, uint octant) {
    global const Wide8Node *nodes = (global const Wide8Node *)scene->nodes;
    PacketStreamStack stack;
    stack.depth = 0u;
    push_packets(&stack, 0u, root, packets, 0.0f);
    while (stack.depth != 0u) {
        const uint top = --stack.depth;
        const int child = stack.child[top];
        const uint left = packets_beyond(stream, stack.packets[top], stack.near[top]);
        if (left == 0u)
            continue;
        if (child >= 0)
            visit_node(scene, stream, nodes + child, left, octant, &stack);
        else
            test_leaf_of_packets(scene, instance, stream, child, left);
    }
}

#endif
