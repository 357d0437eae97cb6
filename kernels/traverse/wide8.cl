/* One ray against eight boxes, then against eight triangles, with OpenCL vectors, for CPUs: the
 * single-ray traversal of wide BVHs after Wald, Benthin and Boulos 2008, "Getting Rid of Packets",
 * with the children that a closest-hit ray enters visited from near to far. */
#include "lib/traverse_block8.h"

/* Each level leaves at most seven siblings behind. */
#define STACK_SIZE (7 * MACULA_MAX_DEPTH + 8)

/* Puts the entered children on the stack. A closest-hit query finds the nearest on top, since the
 * others are sorted below it; an any-hit query does not sort. */
static inline uint push_children(global const Wide8Node* node, ulong lanes, float8 near, int* stack,
                                 float* stack_t, uint depth) {
#if !MACULA_ANY_HIT
    float t_of_lane[8];
    vstore8(near, 0, t_of_lane);
    const uint base = depth;
#endif
    while (lanes != 0ul) {
        const uint lane = first_lane8(lanes);
        lanes = without_lane8(lanes, lane);
        uint i = depth++;
#if !MACULA_ANY_HIT
        const float t = t_of_lane[lane];
        for (; i > base && stack_t[i - 1u] < t; --i) {
            stack[i] = stack[i - 1u];
            stack_t[i] = stack_t[i - 1u];
        }
        stack_t[i] = t;
#endif
        stack[i] = node->child[lane];
    }
    return depth;
}

static inline bool traverse_lower(const TraceScene* scene, TraceQuery* query, int root) {
    global const Wide8Node* nodes = (global const Wide8Node*)scene->nodes;
    int stack[STACK_SIZE];
    float stack_t[MACULA_ANY_HIT ? 1 : STACK_SIZE];
    stack[0] = root;
    stack_t[0] = 0.0f;
    uint depth = 1u;
    while (depth != 0u) {
        const int node = stack[--depth];
#if !MACULA_ANY_HIT
        if (stack_t[depth] > query->ray.t_max)
            continue;
#endif
        if (node >= 0) {
            float8 near;
            const ulong lanes = enter_wide8(nodes + node, &query->ray, &near);
            depth = push_children(nodes + node, lanes, near, stack, stack_t, depth);
        } else if (test_leaf_of_blocks(scene, query, node)) {
            return true;
        }
    }
    return false;
}

#include "lib/traverse_one_ray.h"
