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

static inline void axis_bounds8(global const TriangleBlock8* block, uint axis, float8* lo,
                                float8* hi) {
    const float8 a = vload8(0, block->v[0][axis]);
    const float8 b = vload8(0, block->v[1][axis]);
    const float8 c = vload8(0, block->v[2][axis]);
    *lo = m_min8(m_min8(a, b), c);
    *hi = m_max8(m_max8(a, b), c);
}

/* The box_interval of each triangle's own box with its triangle_margin. Of `r`, only what
 * box_interval needs. */
static inline void triangle_intervals8(const TraceRay* r, global const TriangleBlock8* block,
                                       float8* near, float8* far) {
    float8 lx, ly, lz, hx, hy, hz;
    axis_bounds8(block, 0u, &lx, &hx);
    axis_bounds8(block, 1u, &ly, &hy);
    axis_bounds8(block, 2u, &lz, &hz);
    const float8 size = m_max8(m_max8(m_max8(-lx, hx), m_max8(-ly, hy)),
                               m_max8(m_max8(-lz, hz), (float8)(0x1p-19f)));
    const float8 margin = MACULA_TRIANGLE_MARGIN * size;
    lx -= margin;
    ly -= margin;
    lz -= margin;
    hx += margin;
    hy += margin;
    hz += margin;
    const bool sx = (r->octant & 1u) != 0u, sy = (r->octant & 2u) != 0u,
               sz = (r->octant & 4u) != 0u;
    box_interval8(r, sx ? hx : lx, sy ? hy : ly, sz ? hz : lz, sx ? lx : hx, sy ? ly : hy,
                  sz ? lz : hz, near, far);
}

#endif
