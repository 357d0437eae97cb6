/* Stackless traversal by skip pointers: Thrane and Simonsen 2005, "A Comparison of Acceleration
 * Structures for GPU Assisted Ray Tracing"; Smith et al. 2014 render with it. Nodes lie in
 * depth-first order, so that the order of visits is the same for all rays. */
#include "lib/traverse_query.h"

static inline bool traverse_lower(const TraceScene* scene, TraceQuery* query, int root) {
    global const SkipNode* nodes = (global const SkipNode*)scene->nodes;
    uint i = (uint)root;
    while (i != MACULA_SKIP_END) {
        global const SkipNode* node = nodes + i;
        float near, far;
        box_interval(&query->ray, node->lo[0], node->lo[1], node->lo[2], node->hi[0], node->hi[1],
                     node->hi[2], &near, &far);
        const bool enter = near <= far && near <= query->ray.t_max;
        if (enter && node->leaf != 0u && test_leaf(scene, query, (int)~node->leaf))
            return true;
        i = enter && node->leaf == 0u ? i + 1u : node->skip;
    }
    return false;
}

#include "lib/traverse_one_ray.h"
