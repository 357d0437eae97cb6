/* One ray against eight boxes, then against eight triangles, with OpenCL vectors, for CPUs: the
 * single-ray traversal of wide BVHs after Wald, Benthin and Boulos 2008, "Getting Rid of Packets",
 * with the children that a closest-hit ray enters visited from near to far. */
#include "lib/wide_block.h"

/* Each level leaves at most seven siblings behind. */
#define STACK_SIZE (7 * MACULA_MAX_DEPTH)
#define NOTHING_LEFT ((int)0x80000000)

typedef struct ChildStack {
    int child[STACK_SIZE];
    float near[MACULA_ANY_HIT ? 1 : STACK_SIZE];
    uint depth;
} ChildStack;

/* The next child whose box is not behind the best hit. */
static inline int pop_child(ChildStack* stack, float t_max) {
    while (stack->depth != 0u) {
        --stack->depth;
#if !MACULA_ANY_HIT
        if (stack->near[stack->depth] > t_max)
            continue;
#endif
        return stack->child[stack->depth];
    }
    return NOTHING_LEFT;
}

#if MACULA_ANY_HIT
/* Returns one of the entered children and leaves the others on the stack. */
static inline int choose_child(global const Wide8Node* node, ulong lanes, float8 near,
                               ChildStack* stack) {
    uint lane = first_lane8(lanes);
    lanes = without_lane8(lanes, lane);
    while (lanes != 0ul) {
        stack->child[stack->depth++] = node->child[lane];
        lane = first_lane8(lanes);
        lanes = without_lane8(lanes, lane);
    }
    return node->child[lane];
}
#else
/* Returns the nearest of the entered children and leaves the others on the stack, the next one on
 * top. */
static inline int choose_child(global const Wide8Node* node, ulong lanes, float8 near,
                               ChildStack* stack) {
    const float* near_of_lane = (const float*)&near;
    const uint base = stack->depth;
    const uint lane = first_lane8(lanes);
    int nearest = node->child[lane];
    float least = near_of_lane[lane];
    lanes = without_lane8(lanes, lane);
    while (lanes != 0ul) {
        const uint next = first_lane8(lanes);
        lanes = without_lane8(lanes, next);
        const float t = near_of_lane[next];
        const bool nearer = t < least;
        const float later_t = nearer ? least : t;
        const int later = nearer ? nearest : node->child[next];
        least = nearer ? t : least;
        nearest = nearer ? node->child[next] : nearest;
        uint i = stack->depth++;
        for (; i > base && stack->near[i - 1u] < later_t; --i) {
            stack->child[i] = stack->child[i - 1u];
            stack->near[i] = stack->near[i - 1u];
        }
        stack->child[i] = later;
        stack->near[i] = later_t;
    }
    return nearest;
}
#endif

static inline bool traverse_lower(const TraceScene* scene, TraceQuery* query, int root) {
    global const Wide8Node* nodes = (global const Wide8Node*)scene->nodes;
    BlockRay ray;
    ray.query = *query;
    permute_origin(&ray);
    ChildStack stack;
    stack.depth = 0u;
    int node = root;
    bool answered = false;
    while (node != NOTHING_LEFT && !answered) {
        if (node >= 0) {
            float8 near;
            const ulong lanes = enter_wide8(nodes + node, &ray.query.ray, &near);
            node = lanes != 0ul ? choose_child(nodes + node, lanes, near, &stack)
                                : pop_child(&stack, ray.query.ray.t_max);
        } else {
            answered = test_leaf_of_blocks(scene, &ray, node);
            node = pop_child(&stack, ray.query.ray.t_max);
        }
    }
    query->ray.t_max = ray.query.ray.t_max;
    query->best = ray.query.best;
    return answered;
}

#include "lib/traverse_one_ray.h"
