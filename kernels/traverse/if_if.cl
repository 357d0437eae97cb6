/* Aila and Laine 2009, section 4: if-if. One node a turn of the loop, inner or leaf. */
#include "lib/traverse_binary.h"
#include "lib/traverse_query.h"

static inline bool traverse_lower(const TraceScene* scene, TraceQuery* query, int root) {
    global const BinaryNode* nodes = (global const BinaryNode*)scene->nodes;
    int stack[MACULA_BINARY_STACK];
    uint depth = 1u;
    stack[0] = MACULA_NO_CHILD;
    int node = root;
    while (node != MACULA_NO_CHILD) {
        if (node >= 0)
            node = descend(nodes + node, &query->ray, stack, &depth);
        if (node < 0 && node != MACULA_NO_CHILD) {
            if (test_leaf(scene, query, node))
                return true;
            node = stack[--depth];
        }
    }
    return false;
}

#include "lib/traverse_one_ray.h"
