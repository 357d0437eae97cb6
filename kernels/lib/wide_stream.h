/* Up to 32 rays of one class, in no other way alike, through the lower level in one traversal: a
 * node is loaded once for all rays that reach it. Layout wide8_block. (After Tsakok 2009, "Faster
 * Incoherent Rays: Multi-BVH Ray Stream Tracing".) There is no branch on what single rays find: a
 * branch that waits for a box test costs as much as several of them. OpenCL C only. */
#ifndef MACULA_LIB_WIDE_STREAM_H
#define MACULA_LIB_WIDE_STREAM_H

#include "lib/wide_push.h"
#include "lib/wide_stream_leaf.h"

/* Each level leaves at most seven siblings behind; a push writes eight children, and two entries
 * lie below the first, so that the two on top can always be fetched. */
#define MACULA_STREAM_BOTTOM 2u
#define MACULA_STREAM_STACK (7 * MACULA_MAX_DEPTH + 16)

/* Far planes are moved away by more than what box_interval adds to far distances, so that rays need
 * only one offset an axis (docs/arithmetic.md). */
static inline float8 far_plane8(global const Wide8Node* node, uint axis, const StreamClass* c) {
    return vload8(0, node->plane[axis][((c->octant >> axis) & 1u) ^ 1u]) + (float8)(c->pad[axis]);
}

static inline float8 near_plane8(global const Wide8Node* node, uint axis, const StreamClass* c) {
    return vload8(0, node->plane[axis][(c->octant >> axis) & 1u]);
}

/* What the rays find in a node. Lane c of `rays` is the mask of those that enter child c, lane c of
 * `nearest` bounds the t at which one does. */
typedef struct StreamChildren {
    int8 rays;
    float8 nearest;
} StreamChildren;

static inline StreamChildren enter_children8(global const Wide8Node* node, const StreamRay* ray,
                                             const StreamClass* c, uint rays) {
    const float16 near_x = twice(near_plane8(node, 0u, c)), far_x = twice(far_plane8(node, 0u, c));
    const float16 near_y = twice(near_plane8(node, 1u, c)), far_y = twice(far_plane8(node, 1u, c));
    const float16 near_z = twice(near_plane8(node, 2u, c)), far_z = twice(far_plane8(node, 2u, c));
    int16 entered = 0;
    float16 nearest = MACULA_EMPTY;
    do {
        const RayPair pair = next_pair(&rays);
        const float16 a = ray[pair.first].row, b = ray[pair.second].row;
        const float16 rx = MACULA_OF_BOTH(a, b, s0), nx = MACULA_OF_BOTH(a, b, s3);
        const float16 ry = MACULA_OF_BOTH(a, b, s1), ny = MACULA_OF_BOTH(a, b, s4);
        const float16 rz = MACULA_OF_BOTH(a, b, s2), nz = MACULA_OF_BOTH(a, b, s5);
        const float16 near = m_max(m_max(fma(near_x, rx, nx), fma(near_y, ry, ny)),
                                   m_max(fma(near_z, rz, nz), (float16)(0.0f)));
        const float16 far = m_min(m_min(fma(far_x, rx, nx), fma(far_y, ry, ny)),
                                  m_min(fma(far_z, rz, nz), MACULA_OF_BOTH(a, b, s6)));
        const int16 enters = near <= far;
        entered |= enters & as_int16(MACULA_OF_BOTH(a, b, se));
        nearest = enters ? m_min(nearest, near) : nearest;
    } while (rays != 0u);
    StreamChildren found;
    found.rays = entered.lo | entered.hi;
    found.nearest = m_min8(nearest.lo, nearest.hi);
    return found;
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

typedef struct StreamWalk {
    int child[MACULA_STREAM_STACK];
    int rays[MACULA_STREAM_STACK]; /* those that enter the child */
    /* At most the t at which one does. */
    float near[MACULA_ANY_HIT ? 1 : MACULA_STREAM_STACK];
    uint depth;
    uint answered; /* rays whose query is answered */
} StreamWalk;

static inline void start_walk(StreamWalk* walk, int root, uint rays) {
    for (uint i = 0u; i <= MACULA_STREAM_BOTTOM; ++i)
        walk->child[i] = root;
    walk->rays[MACULA_STREAM_BOTTOM] = (int)rays;
    walk->depth = MACULA_STREAM_BOTTOM + (rays != 0u ? 1u : 0u);
    walk->answered = 0u;
#if !MACULA_ANY_HIT
    walk->near[MACULA_STREAM_BOTTOM] = 0.0f;
#endif
}

/* Puts the children that are entered on the stack. The one that is entered first by some ray of a
 * closest-hit query comes to lie on top; of any-hit queries the largest one, the node's first: to
 * sort those costs more than it saves. */
static inline void push_rays(StreamWalk* walk, global const Wide8Node* node,
                             const StreamChildren* found) {
    const int8 child = vload8(0, node->child);
#if MACULA_ANY_HIT
    const int8 enters = found->rays.s76543210 != 0;
    vstore8(compressed8(child.s76543210, enters), 0, walk->child + walk->depth);
    vstore8(compressed8(found->rays.s76543210, enters), 0, walk->rays + walk->depth);
#else
    const int8 order = sorted8(child_keys8(found->rays, as_int8(found->nearest) & ~7));
    vstore8(permuted8(child, order), 0, walk->child + walk->depth);
    vstore8(permuted8(found->rays, order), 0, walk->rays + walk->depth);
    vstore8(as_float8(permuted8(as_int8(found->nearest), order)), 0, walk->near + walk->depth);
#endif
    walk->depth += entered_children8(found->rays);
}

/* The rays that may still hit something in entry `top` of the stack. */
static inline uint unfinished_rays(const Stream* s, const StreamWalk* walk, uint top) {
#if MACULA_ANY_HIT
    return ~walk->answered;
#else
    const float16 near = walk->near[top];
    return bits_of_lanes16(near <= s->t_max[0]) | bits_of_lanes16(near <= s->t_max[1]) << 16;
#endif
}

/* Visits the node or leaf on top of the stack. */
static inline void step_walk(const TraceScene* scene, Stream* s, const StreamClass* c,
                             StreamWalk* walk) {
    const uint top = --walk->depth;
    const uint left = (uint)walk->rays[top] & unfinished_rays(s, walk, top);
    const int child = walk->child[top];
    if (left == 0u)
        return;
    if (child < 0) {
        walk->answered |= test_leaf_of_stream(scene, s, c, child, left);
        return;
    }
    global const Wide8Node* node = (global const Wide8Node*)scene->nodes + child;
    const StreamChildren found = enter_children8(node, s->ray, c, left);
    push_rays(walk, node, &found);
    /* A loop over all that were pushed would end at a branch that cannot be foreseen. */
    fetch_child(scene, walk->child[walk->depth - 1u]);
    fetch_child(scene, walk->child[walk->depth - 2u]);
}

static inline bool is_walking(const StreamWalk* walk) {
    return walk->depth != MACULA_STREAM_BOTTOM;
}

#endif
