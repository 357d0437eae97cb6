/* Up to 32 rays of one class, in no other way alike, through the lower level in one traversal: a
 * node is loaded once for all rays that reach it. Layout wide8_block. (After Tsakok 2009, "Faster
 * Incoherent Rays: Multi-BVH Ray Stream Tracing".) There is no branch on what single rays find: a
 * branch that waits for a box test costs as much as several of them. OpenCL C only. */
#ifndef MACULA_LIB_WIDE_STREAM_H
#define MACULA_LIB_WIDE_STREAM_H

#include "lib/wide_push.h"
#include "lib/wide_stream_leaf.h"

/* Each level leaves at most seven siblings behind; a push writes all eight children. */
#define MACULA_STREAM_STACK (7 * MACULA_MAX_DEPTH + 16)

/* Far planes are moved away by more than what box_interval adds to far distances, so that rays need
 * only one offset an axis (docs/arithmetic.md). */
static inline float8 far_plane8(global const Wide8Node* node, uint axis, const StreamClass* c) {
    const uint side = (c->octant >> axis) & 1u;
    const float8 plane = vload8(0, node->plane[axis][side ^ 1u]);
    const float8 pad = fma(fabs(plane), (float8)(0x1p-19f), (float8)(c->margin));
    return side != 0u ? plane - pad : plane + pad;
}

static inline float8 near_plane8(global const Wide8Node* node, uint axis, const StreamClass* c) {
    return vload8(0, node->plane[axis][(c->octant >> axis) & 1u]);
}

/* What the rays find in a node. Lane c of `rays` is the mask of those that enter child c; children
 * are visited in the order of `key`, which differ; keys of those that no ray enters are negative.
 */
typedef struct StreamChildren {
    int8 rays;
    int8 key;
} StreamChildren;

/* The child that most rays of an any-hit query enter comes first, else the one that is entered
 * first by some ray. */
static inline StreamChildren enter_children8(global const Wide8Node* node, const Stream* s,
                                             const StreamClass* c, uint rays) {
    const float8 near_plane_x = near_plane8(node, 0u, c), far_plane_x = far_plane8(node, 0u, c);
    const float8 near_plane_y = near_plane8(node, 1u, c), far_plane_y = far_plane8(node, 1u, c);
    const float8 near_plane_z = near_plane8(node, 2u, c), far_plane_z = far_plane8(node, 2u, c);
    StreamChildren found;
    found.rays = 0;
    float8 nearest = MACULA_EMPTY;
    int8 missing = 33;
    do {
        const uint k = first_bit(rays);
        rays &= rays - 1u;
        const float8 near_x = fma(near_plane_x, (float8)(s->r[0][k]), (float8)(s->n[0][k]));
        const float8 near_y = fma(near_plane_y, (float8)(s->r[1][k]), (float8)(s->n[1][k]));
        const float8 near_z = fma(near_plane_z, (float8)(s->r[2][k]), (float8)(s->n[2][k]));
        const float8 far_x = fma(far_plane_x, (float8)(s->r[0][k]), (float8)(s->n[0][k]));
        const float8 far_y = fma(far_plane_y, (float8)(s->r[1][k]), (float8)(s->n[1][k]));
        const float8 far_z = fma(far_plane_z, (float8)(s->r[2][k]), (float8)(s->n[2][k]));
        const float8 near = m_max8(m_max8(near_x, near_y), m_max8(near_z, (float8)(0.0f)));
        const float8 far = m_min8(m_min8(far_x, far_y), m_min8(far_z, (float8)(s->t_max[k])));
        const int8 enters = near <= far;
        found.rays |= enters & (int8)((int)(1u << k));
#if MACULA_ANY_HIT
        missing += enters;
#else
        nearest = enters ? m_min8(nearest, near) : nearest;
#endif
    } while (rays != 0u);
#if MACULA_ANY_HIT
    const int8 key = missing << 3;
#else
    const int8 key = as_int8(nearest) & ~7;
#endif
    found.key = child_keys8(found.rays, key);
    return found;
}

static inline uint push_rays(MaskedEntry* stack, uint depth, global const Wide8Node* node,
                             const StreamChildren* found) {
    const int8 place = push_places8(found->key);
    stack += depth;
    put_entry(stack, place.s0, (uint)node->child[0], found->rays.s0);
    put_entry(stack, place.s1, (uint)node->child[1], found->rays.s1);
    put_entry(stack, place.s2, (uint)node->child[2], found->rays.s2);
    put_entry(stack, place.s3, (uint)node->child[3], found->rays.s3);
    put_entry(stack, place.s4, (uint)node->child[4], found->rays.s4);
    put_entry(stack, place.s5, (uint)node->child[5], found->rays.s5);
    put_entry(stack, place.s6, (uint)node->child[6], found->rays.s6);
    put_entry(stack, place.s7, (uint)node->child[7], found->rays.s7);
    return depth + entered_children8(found->rays);
}

static inline void fetch_child(const TraceScene* scene, int child) {
    const ulong node = (ulong)((global const Wide8Node*)scene->nodes + child);
    const ulong block = (ulong)((global const TriangleBlock8*)scene->triangles +
                                ((uint)~child >> MACULA_LEAF_COUNT_BITS));
    const ulong address = child >= 0 ? node : block;
    MACULA_FETCH(address, 0);
    MACULA_FETCH(address, 64);
    MACULA_FETCH(address, 128);
    MACULA_FETCH(address, 192);
    MACULA_FETCH(address, 256);
}

/* Chunks that a traversal advances in turn: what one finds in a node takes longer to know than to
 * compute, and meanwhile the other computes. */
#define MACULA_STREAM_CHUNKS 2u

typedef struct StreamWalk {
    MaskedEntry stack[MACULA_STREAM_STACK];
    uint depth;
    uint answered; /* rays whose query is answered */
} StreamWalk;

static inline void start_walk(StreamWalk* walk, int root, uint rays) {
    walk->stack[0].child = (uint)root;
    walk->stack[0].mask = rays;
    walk->depth = rays != 0u ? 1u : 0u;
    walk->answered = 0u;
}

/* Visits the node or leaf on top of the stack. */
static inline void step_walk(const TraceScene* scene, Stream* s, const StreamClass* c,
                             StreamWalk* walk) {
    const MaskedEntry entry = walk->stack[--walk->depth];
    const uint left = entry.mask & ~walk->answered;
    const int child = (int)entry.child;
    if (left == 0u)
        return;
    if (child < 0) {
        walk->answered |= test_leaf_of_stream(scene, s, c, child, left);
        return;
    }
    global const Wide8Node* node = (global const Wide8Node*)scene->nodes + child;
    const StreamChildren found = enter_children8(node, s, c, left);
    const uint before = walk->depth;
    walk->depth = push_rays(walk->stack, before, node, &found);
    for (uint i = before; i < walk->depth; ++i)
        fetch_child(scene, (int)walk->stack[i].child);
}

/* `s` and `walk`: one for each chunk. */
static inline void traverse_stream(const TraceScene* scene, Stream* s, const StreamClass* c,
                                   StreamWalk* walk) {
    uint i = 0u;
    while ((walk[0].depth | walk[1].depth) != 0u) {
        i = walk[i ^ 1u].depth != 0u ? i ^ 1u : i;
        step_walk(scene, s + i, c, walk + i);
    }
}

#endif
