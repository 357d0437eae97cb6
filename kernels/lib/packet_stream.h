/* Up to 32 packets of one octant through the lower level in one traversal: a node is loaded once
 * for all packets that reach it. Layout wide8_single. OpenCL C only. */
#ifndef MACULA_LIB_PACKET_STREAM_H
#define MACULA_LIB_PACKET_STREAM_H

#include "lib/packet_traverse.h"

#define MACULA_PACKETS (MACULA_RAYS_PER_ITEM / 16)

/* Bit k of a packet mask stands for packet k of the stream. */
typedef struct PacketStream {
    Packet packet[MACULA_PACKETS];
    PacketHit best[MACULA_PACKETS];
    Frustum frustum[MACULA_PACKETS];
    float margin; /* the greatest of the frusta */
    uint wide;    /* packets whose frustum is a loose bound: their lanes are tested at every node */
} PacketStream;

/* A child to visit is child slot % 8 of node slot / 8. */
typedef struct PacketStreamStack {
    uint slot[MACULA_WIDE_STACK];
    uint packets[MACULA_WIDE_STACK];
    float near[MACULA_WIDE_STACK];
} PacketStreamStack;

static inline uint first_bit(uint mask) {
    return 31u - (uint)clz(mask & (~mask + 1u));
}

static inline void push_packets(PacketStreamStack* stack, uint base, uint i, uint slot,
                                uint packets, float near) {
    for (; i > base && stack->near[i - 1u] < near; --i) {
        stack->near[i] = stack->near[i - 1u];
        stack->slot[i] = stack->slot[i - 1u];
        stack->packets[i] = stack->packets[i - 1u];
    }
    stack->near[i] = near;
    stack->slot[i] = slot;
    stack->packets[i] = packets;
}

/* Tests the packets' frusta against a node's children and puts those that are entered on the stack
 * of `depth` entries; returns how many there are now. */
static inline uint visit_node(const TraceScene* scene, const PacketStream* stream, uint index,
                              uint packets, uint octant, bool mixed, PacketStreamStack* stack,
                              uint depth) {
    global const Wide8Node* node = (global const Wide8Node*)scene->nodes + index;
    const WidePlanes planes = load_planes(node, octant);
    int8 found = 0;
    float8 nearest = MACULA_EMPTY;
    do {
        const uint k = first_bit(packets);
        packets &= packets - 1u;
        float8 near;
        const int8 enters = enter_frustum8(stream->frustum + k, mixed, &planes, &near);
        found |= enters & (int8)((int)(1u << k));
        nearest = enters ? m_min8(nearest, near) : nearest;
    } while (packets != 0u);
    const uint base = depth;
    for (ulong lanes = lane_mask8(found != 0); lanes != 0ul; ++depth) {
        const uint i = first_lane8(lanes);
        lanes = without_lane8(lanes, i);
        fetch_child_single(scene, node->child[i]);
        push_packets(stack, base, depth, index * 8u + i, ((const uint*)&found)[i],
                     ((const float*)&nearest)[i]);
    }
    return depth;
}

/* The packets with a lane that may enter a box. */
static inline uint packets_in_box(const PacketStream* stream, uint packets, bool mixed, uint octant,
                                  global const Wide8Node* node, uint i) {
    const BoxPlanes box = box_planes(node, i, octant, stream->margin);
    uint kept = 0u;
    for (; packets != 0u; packets &= packets - 1u) {
        const uint k = first_bit(packets);
        const Packet* p = stream->packet + k;
        const bool enters =
            mixed ? may_enter_mixed(p, node, i) : may_enter(p, stream->frustum[k].t_min, &box);
        kept |= enters ? 1u << k : 0u;
    }
    return kept;
}

static inline void test_leaf_of_packets(const TraceScene* scene, const PacketInstance* instance,
                                        PacketStream* stream, int leaf, uint packets) {
    for (; packets != 0u; packets &= packets - 1u) {
        const uint k = first_bit(packets);
        if (test_leaf16(scene, instance, stream->packet + k, stream->best + k, leaf))
            stream->frustum[k].t_max = bound_t_max(stream->packet + k);
    }
}

/* Takes the next inner node that some packets reach from the stack, testing the leaves before it;
 * returns the packets, none when the stack is empty. That packets may be done is left to the box
 * tests: a mask of them would make every step wait for the hits of the last one. */
static inline uint next_node(const TraceScene* scene, const PacketInstance* instance,
                             PacketStream* stream, uint octant, bool mixed,
                             const PacketStreamStack* stack, uint* depth, uint* index) {
    global const Wide8Node* nodes = (global const Wide8Node*)scene->nodes;
    while (*depth != 0u) {
        const uint top = --(*depth);
        const uint packets = stack->packets[top];
        global const Wide8Node* node = nodes + (stack->slot[top] >> 3);
        const uint i = stack->slot[top] & 7u;
        const int child = node->child[i];
        const uint by_lane = child >= 0 ? packets & stream->wide : packets;
        const uint left =
            (packets & ~by_lane) | packets_in_box(stream, by_lane, mixed, octant, node, i);
        if (left == 0u)
            continue;
        if (child >= 0) {
            *index = (uint)child;
            return left;
        }
        test_leaf_of_packets(scene, instance, stream, child, left);
    }
    return 0u;
}

static inline void traverse_packets(const TraceScene* scene, const PacketInstance* instance,
                                    PacketStream* stream, int root, uint packets, uint octant,
                                    bool mixed) {
    PacketStreamStack stack;
    uint depth = 0u, index = (uint)root;
    while (packets != 0u) {
        depth = visit_node(scene, stream, index, packets, octant, mixed, &stack, depth);
        packets = next_node(scene, instance, stream, octant, mixed, &stack, &depth, &index);
    }
}

#endif
