/* The children that a traversal of 8-wide nodes has still to visit. OpenCL C only. */
#ifndef MACULA_LIB_WIDE_STACK_H
#define MACULA_LIB_WIDE_STACK_H

#include "lib/simd.h"
#include "lib/traverse_query.h"

/* Each level leaves at most seven siblings behind. */
#define MACULA_WIDE_STACK (7 * MACULA_MAX_DEPTH + 8)

/* Children to visit, those of a closest-hit query with the t at which they are entered. */
typedef struct WideStack {
    int child[MACULA_WIDE_STACK];
    float near[MACULA_ANY_HIT ? 1 : MACULA_WIDE_STACK];
} WideStack;

/* Asks the cache for a child of layout wide8_single: a node, or two Triangles. */
static inline void fetch_child_single(const TraceScene* scene, int child) {
    if (child >= 0) {
        global const Wide8Node* node = (global const Wide8Node*)scene->nodes + child;
        MACULA_FETCH(node, 0);
        MACULA_FETCH(node, 64);
        MACULA_FETCH(node, 128);
        MACULA_FETCH(node, 192);
    } else {
        global const Triangle* triangle =
            (global const Triangle*)scene->triangles + ((uint)~child >> MACULA_LEAF_COUNT_BITS);
        MACULA_FETCH(triangle, 0);
        MACULA_FETCH(triangle, 64);
    }
}

/* Puts a child on a stack of `depth` entries and returns how many there are now. Those of a
 * closest-hit query from `base` on stay sorted, the nearest on top. */
static inline uint push_child(WideStack* stack, uint base, uint depth, int child, float near) {
    uint i = depth;
#if !MACULA_ANY_HIT
    for (; i > base && stack->near[i - 1u] < near; --i) {
        stack->near[i] = stack->near[i - 1u];
        stack->child[i] = stack->child[i - 1u];
    }
    stack->near[i] = near;
#endif
    stack->child[i] = child;
    return depth + 1u;
}

#endif
