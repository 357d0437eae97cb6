/* The while-while loop over the `binary` layout (Aila and Laine 2009, section 4): inner nodes until
 * a leaf is found, then leaves until an inner node is popped. */
#ifndef MACULA_LIB_TRAVERSE_WHILE_WHILE_H
#define MACULA_LIB_TRAVERSE_WHILE_WHILE_H

#include "lib/traverse_binary.h"
#include "lib/traverse_query.h"

static inline bool traverse_lower(const TraceScene* scene, TraceQuery* query, int root) {
    global const BinaryNode* nodes = (global const BinaryNode*)scene->nodes;
    int stack[MACULA_BINARY_STACK];
    uint depth = 1u;
    stack[0] = MACULA_NO_CHILD;
    int node = root;
    while (node != MACULA_NO_CHILD) {
        while (node >= 0)
            node = descend(nodes + node, &query->ray, stack, &depth);
        while (node < 0 && node != MACULA_NO_CHILD) {
            if (test_leaf(scene, query, node))
                return true;
            node = stack[--depth];
        }
    }
    return false;
}

#endif
