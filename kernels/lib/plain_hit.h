/* Where the box of a triangle (docs/arithmetic.md, rule 2) is known to let every hit pass with its
 * t as it is, so that vector variants need not test it: t neither overflows nor is spoilt by what
 * underflows. OpenCL C only. */
#ifndef MACULA_LIB_PLAIN_HIT_H
#define MACULA_LIB_PLAIN_HIT_H

#include "lib/simd.h"
#include "lib/traverse_wide8.h"

/* The largest size of origins, directions and planes, and the least size of the determinant. */
#define MACULA_PLAIN_SIZE 0x1p30f
#define MACULA_PLAIN_DETERMINANT 0x1p-50f

/* The greatest coordinate in size of a root's planes, so of all planes below it. */
static inline float mesh_size(global const Wide8Node* root) {
    float8 size = 0.0f;
    for (uint axis = 0u; axis < 3u; ++axis) {
        const float8 lo = vload8(0, root->plane[axis][0]), hi = vload8(0, root->plane[axis][1]);
        const float8 own = m_max8(m_max8(-lo, hi), size);
        size = lo <= hi ? own : size; /* an unused child is inside out */
    }
    return greatest_lane16((float16)(size, size));
}

#endif
