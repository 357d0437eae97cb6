/* Up to 32 packets of one octant through the lower level in one traversal: a node is loaded once
 * for all packets that reach it. Layout wide8_single. OpenCL C only. */
#ifndef MACULA_LIB_PACKET_STREAM_H
#define MACULA_LIB_PACKET_STREAM_H

#include "lib/packet_traverse.h"
#include "lib/wide_push.h"

#define MACULA_PACKETS (MACULA_RAYS_PER_ITEM / 16)

/* Bit k of a packet mask stands for packet k of the stream. */
typedef struct PacketStream {
    Packet packet[MACULA_PACKETS];
    PacketHit best[MACULA_PACKETS];
    Frustum frustum[MACULA_PACKETS];
    float margin; /* the greatest of the frusta */
    uint wide;    /* packets whose frustum is a loose bound: their lanes are tested at every node */
} PacketStream;

/* Each level leaves at most seven siblings behind; a push writes all eight children. */
#define MACULA_PACKET_STACK (MACULA_WIDE_STACK + 8)

/* Puts the children that are entered on the stack, the nearest on top: child `slot % 8` of node
 * `slot / 8`. */
static inline uint push_packets(MaskedEntry* stack, uint depth, uint index, int8 found,
                                float8 nearest) {
    const uint slot = index * 8u;
    const int8 place = push_places8(child_keys8(found, as_int8(nearest) & ~7));
    stack += depth;
    put_entry(stack, place.s0, slot, found.s0);
    put_entry(stack, place.s1, slot + 1u, found.s1);
    put_entry(stack, place.s2, slot + 2u, found.s2);
    put_entry(stack, place.s3, slot + 3u, found.s3);
    put_entry(stack, place.s4, slot + 4u, found.s4);
    put_entry(stack, place.s5, slot + 5u, found.s5);
    put_entry(stack, place.s6, slot + 6u, found.s6);
    put_entry(stack, place.s7, slot + 7u, found.s7);
    return depth + entered_children8(found);
}

/* Tests the packets' frusta against a node's children and puts those that are entered on the stack
 * of `depth` entries; returns how many there are now. */
static inline uint visit_node(const TraceScene* scene, const PacketStream* stream, uint index,
                              uint packets, uint octant, bool mixed, MaskedEntry* stack,
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
    const uint end = push_packets(stack, depth, index, found, nearest);
    for (; depth < end; ++depth)
        fetch_child_single(scene, node->child[stack[depth].child & 7u]);
    return end;
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
            bound_t_max(stream->frustum + k, stream->packet + k);
    }
}

/* Takes the next inner node that some packets reach from the stack, testing the leaves before it;
 * returns the packets, none when the stack is empty. That packets may be done is left to the box
 * tests: a mask of them would make every step wait for the hits of the last one. */
static inline uint next_node(const TraceScene* scene, const PacketInstance* instance,
                             PacketStream* stream, uint octant, bool mixed,
                             const MaskedEntry* stack, uint* depth, uint* index) {
    global const Wide8Node* nodes = (global const Wide8Node*)scene->nodes;
    while (*depth != 0u) {
        const uint top = --(*depth);
        const uint packets = stack[top].mask;
        global const Wide8Node* node = nodes + (stack[top].child >> 3);
        const uint i = stack[top].child & 7u;
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

/* `frustum_octant`: that of the frusta, the opposite one where they are those of the rays' ends. */
static inline void traverse_packets(const TraceScene* scene, const PacketInstance* instance,
                                    PacketStream* stream, int root, uint packets, uint octant,
                                    uint frustum_octant, bool mixed) {
    MaskedEntry stack[MACULA_PACKET_STACK];
    uint depth = 0u, index = (uint)root;
    while (packets != 0u) {
        depth = visit_node(scene, stream, index, packets, frustum_octant, mixed, stack, depth);
        packets = next_node(scene, instance, stream, octant, mixed, stack, &depth, &index);
    }
}

#endif
