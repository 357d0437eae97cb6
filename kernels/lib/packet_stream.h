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
#define MACULA_PACKET_STACK (7 * MACULA_MAX_DEPTH + 16)

typedef struct PacketStack {
    int child[MACULA_PACKET_STACK];
    int slot[MACULA_PACKET_STACK];    /* its box is number slot % 8 of node slot / 8 */
    int packets[MACULA_PACKET_STACK]; /* those that enter it */
    uint depth;
} PacketStack;

/* Children are ordered by the t at which some packet enters them, nearest on top. For any-hit
 * queries t is rounded to two bits, and of children about as near the largest, so the node's first,
 * comes first: it is the likeliest to hold what blocks the light. */
#define MACULA_ORDER_BITS (MACULA_ANY_HIT ? ~0x3fffff : ~7)

/* Puts the children of node `index` that packets enter on the stack. */
static inline void push_packets(PacketStack* stack, global const Wide8Node* node, uint index,
                                int8 packets, float8 nearest) {
    const int8 order = sorted8(child_keys8(packets, as_int8(nearest) & MACULA_ORDER_BITS));
    const int8 slot = (int8)((int)(index * 8u)) | MACULA_LANES8;
    vstore8(permuted8(vload8(0, node->child), order), 0, stack->child + stack->depth);
    vstore8(permuted8(slot, order), 0, stack->slot + stack->depth);
    vstore8(permuted8(packets, order), 0, stack->packets + stack->depth);
    stack->depth += entered_children8(packets);
}

/* Tests the packets' frusta against a node's children and puts those that are entered on the stack.
 */
static inline void visit_node(const TraceScene* scene, const PacketStream* stream, uint index,
                              uint packets, uint octant, bool mixed, PacketStack* stack) {
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
    uint pushed = stack->depth;
    push_packets(stack, node, index, found, nearest);
    for (; pushed < stack->depth; ++pushed)
        fetch_child_single(scene, stack->child[pushed]);
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
                             PacketStream* stream, uint octant, bool mixed, PacketStack* stack,
                             uint* index) {
    global const Wide8Node* nodes = (global const Wide8Node*)scene->nodes;
    while (stack->depth != 0u) {
        const uint top = --stack->depth;
        const uint packets = (uint)stack->packets[top];
        const int child = stack->child[top];
        const uint slot = (uint)stack->slot[top];
        const uint by_lane = child >= 0 ? packets & stream->wide : packets;
        const uint left = (packets & ~by_lane) | packets_in_box(stream, by_lane, mixed, octant,
                                                                nodes + slot / 8u, slot % 8u);
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
    PacketStack stack;
    stack.depth = 0u;
    uint index = (uint)root;
    while (packets != 0u) {
        visit_node(scene, stream, index, packets, frustum_octant, mixed, &stack);
        packets = next_node(scene, instance, stream, octant, mixed, &stack, &index);
    }
}

#endif
