/* Parts of the ray/triangle test of lib/triangle.h in eight lanes, for the TriangleBlock8 of one
 * ray: the same arithmetic, operation for operation. OpenCL C only. */
#ifndef MACULA_LIB_TRAVERSE_BLOCK8_H
#define MACULA_LIB_TRAVERSE_BLOCK8_H

#include "lib/traverse_query.h"
#include "lib/traverse_wide8.h"

static inline float8 difference_of_products8(float8 a, float8 b, float8 c, float8 d) {
    const float8 cd = c * d;
    return fma(a, b, -cd) + fma(-c, d, cd);
}

static inline float8 snap_tiny8(float8 x) {
    return fabs(x) < (float8)(0x1p-40f) ? (float8)(0.0f) : x;
}

/* A sheared coordinate of eight vertices: `plane` minus `origin`, moved by their depth. */
static inline float8 sheared8(global const float* plane, float origin, float shear, float8 depth) {
    return snap_tiny8(fma((float8)(-shear), depth, vload8(0, plane) - (float8)(origin)));
}

#endif
