/* One step through a binary node (Aila and Laine 2009, section 3: both children's boxes are in the
 * parent), shared by the binary variants and by the upper level of all one-ray variants. */
#ifndef MACULA_LIB_TRAVERSE_BINARY_H
#define MACULA_LIB_TRAVERSE_BINARY_H

#include "lib/ray.h"
#include "shared/bvh.h"

/* Neither an inner node nor a leaf: nothing is left to visit. */
#define MACULA_NO_CHILD ((int)0x80000000)
/* One entry a level, and the MACULA_NO_CHILD at the bottom. */
#define MACULA_BINARY_STACK (MACULA_MAX_DEPTH + 1)

static inline bool enter_child(global const BinaryNode* node, uint child, const TraceRay* ray,
                               float* near) {
    float far;
    box_interval(ray, node->box[child][0][0], node->box[child][1][0], node->box[child][2][0],
                 node->box[child][0][1], node->box[child][1][1], node->box[child][2][1], near,
                 &far);
    return *near <= far && *near <= ray->t_max;
}

/* The nearer of the children that the ray enters; the other one goes to *later. Either may be
 * MACULA_NO_CHILD. */
static inline int enter_children(global const BinaryNode* node, const TraceRay* ray, int* later) {
    float near0, near1;
    const bool enter0 = enter_child(node, 0u, ray, &near0);
    const bool enter1 = enter_child(node, 1u, ray, &near1);
    const int child0 = enter0 ? node->child[0] : MACULA_NO_CHILD;
    const int child1 = enter1 ? node->child[1] : MACULA_NO_CHILD;
    const bool first_is_1 = enter1 && (!enter0 || near1 < near0);
    *later = first_is_1 ? child0 : child1;
    return first_is_1 ? child1 : child0;
}

/* The next node to visit: a child, with the other one left on the stack, or the stack's top. */
static inline int descend(global const BinaryNode* node, const TraceRay* ray, int* stack,
                          uint* depth) {
    int later;
    const int next = enter_children(node, ray, &later);
    if (later != MACULA_NO_CHILD)
        stack[(*depth)++] = later;
    return next != MACULA_NO_CHILD ? next : stack[--(*depth)];
}

#endif
