/* Aila and Laine 2009, section 4: speculative while-while. A work-item that has found a leaf
 * postpones it and goes on through inner nodes until it holds a second one, so that its SIMD
 * neighbours seldom wait for it. OpenCL C 1.2 has no vote with which to stop when all neighbours
 * hold a leaf; each work-item decides for itself. */
#include "lib/traverse_binary.h"
#include "lib/traverse_query.h"

static inline bool traverse_lower(const TraceScene* scene, TraceQuery* query, int root) {
    global const BinaryNode* nodes = (global const BinaryNode*)scene->nodes;
    int stack[MACULA_BINARY_STACK];
    uint depth = 1u;
    stack[0] = MACULA_NO_CHILD;
    int node = root;
    int postponed = MACULA_NO_CHILD;
    while (node != MACULA_NO_CHILD || postponed != MACULA_NO_CHILD) {
        while (node >= 0) {
            node = descend(nodes + node, &query->ray, stack, &depth);
            if (node < 0 && node != MACULA_NO_CHILD && postponed == MACULA_NO_CHILD) {
                postponed = node;
                node = stack[--depth];
            }
        }
        if (postponed != MACULA_NO_CHILD && test_leaf(scene, query, postponed))
            return true;
        postponed = MACULA_NO_CHILD;
        if (node != MACULA_NO_CHILD) {
            if (test_leaf(scene, query, node))
                return true;
            node = stack[--depth];
        }
    }
    return false;
}

#include "lib/traverse_one_ray.h"
