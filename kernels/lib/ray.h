/* A ray made ready for traversal, and the box test that every variant, every layout and the
 * brute-force oracle share. This arithmetic decides which hits count: see docs/arithmetic.md. */
#ifndef MACULA_LIB_RAY_H
#define MACULA_LIB_RAY_H

#include "lib/math.h"
#include "shared/ray.h"

MACULA_SHARED_BEGIN

/* Direction components are kept at least this large, so that reciprocals stay finite and nothing
 * is denormal. */
#define MACULA_MIN_DIRECTION 0x1p-24f
/* t of a plane p is fma(p, reciprocal, offset). Rounding is monotonic, so no parent box can cull a
 * child that passes. Offsets are padded by MACULA_RAY_MARGIN * the origin's largest component, as a
 * distance along the axis; triangle boxes carry a margin of their own vertices' size (triangle.h);
 * far planes are scaled by more than the fma's rounding. Together that is more than the error of a
 * computed hit, whose t and sheared edges are off by up to 22 * 2^-24 of the largest difference
 * between a vertex and the origin: so a box, also one that holds only a part of a triangle, is
 * entered by every ray that hits what is in it (docs/arithmetic.md). */
#define MACULA_RAY_MARGIN 0x1p-19f
#define MACULA_FAR_SCALE 0x1.000008p+0f /* 1 + 2^-21 */

typedef struct TraceRay {
    float ox, oy, oz;   /* origin */
    float t_min, t_max; /* interval of valid hits */
    float rx, ry, rz;   /* reciprocal direction, for near planes */
    float nx, ny, nz;   /* offsets for near planes */
    float qx, qy, qz;   /* reciprocal direction for far planes: r * MACULA_FAR_SCALE */
    float fx, fy, fz;   /* offsets for far planes */
    float sx, sy, sz;   /* Woop et al. 2013: shear along the dominant axis, kz */
    uint kx, ky, kz;    /* permutation of axes; kz is the dominant one, winding is not kept */
    uint octant;        /* bit a: direction component a is negative */
} TraceRay;

MACULA_INLINE float pick_axis(uint axis, float x, float y, float z) {
    return axis == 0u ? x : (axis == 1u ? y : z);
}

MACULA_INLINE float bounded_direction(float d) {
    return fabs(d) < MACULA_MIN_DIRECTION
               ? (d < 0.0f ? -MACULA_MIN_DIRECTION : MACULA_MIN_DIRECTION)
               : d;
}

MACULA_INLINE bool ray_is_active(float t_min, float t_max) {
    return t_min >= 0.0f && t_min <= t_max;
}

/* Sets what box_interval needs from the origin and the reciprocal direction. */
MACULA_ALWAYS_INLINE void set_offsets(TraceRay* r) {
    const float px = r->ox * r->rx, py = r->oy * r->ry, pz = r->oz * r->rz;
    const float reach = m_max(m_max(fabs(r->ox), fabs(r->oy)), m_max(fabs(r->oz), 0x1p-20f));
    const float margin = MACULA_RAY_MARGIN * reach;
    r->nx = fma(fabs(r->rx), -margin, -px);
    r->ny = fma(fabs(r->ry), -margin, -py);
    r->nz = fma(fabs(r->rz), -margin, -pz);
    r->qx = r->rx * MACULA_FAR_SCALE;
    r->qy = r->ry * MACULA_FAR_SCALE;
    r->qz = r->rz * MACULA_FAR_SCALE;
    r->fx = fma(fabs(r->rx), margin, -px) * MACULA_FAR_SCALE;
    r->fy = fma(fabs(r->ry), margin, -py) * MACULA_FAR_SCALE;
    r->fz = fma(fabs(r->rz), margin, -pz) * MACULA_FAR_SCALE;
}

MACULA_INLINE TraceRay make_trace_ray(float ox, float oy, float oz, float dx, float dy, float dz,
                                      float t_min, float t_max) {
    TraceRay r;
    dx = bounded_direction(dx);
    dy = bounded_direction(dy);
    dz = bounded_direction(dz);
    r.ox = ox;
    r.oy = oy;
    r.oz = oz;
    r.t_min = t_min;
    r.t_max = t_max;
    r.rx = m_divide(1.0f, dx);
    r.ry = m_divide(1.0f, dy);
    r.rz = m_divide(1.0f, dz);
    set_offsets(&r);
    const float ax = fabs(dx), ay = fabs(dy), az = fabs(dz);
    r.kz = (ax >= ay && ax >= az) ? 0u : (ay >= az ? 1u : 2u);
    r.kx = r.kz == 2u ? 0u : r.kz + 1u;
    r.ky = r.kx == 2u ? 0u : r.kx + 1u;
    r.sz = pick_axis(r.kz, r.rx, r.ry, r.rz);
    r.sx = pick_axis(r.kx, dx, dy, dz) * r.sz;
    r.sy = pick_axis(r.ky, dx, dy, dz) * r.sz;
    r.octant = (dx < 0.0f ? 1u : 0u) | (dy < 0.0f ? 2u : 0u) | (dz < 0.0f ? 4u : 0u);
    return r;
}

/* Entry and exit of the ray into a box. The box is entered when *near <= *far; `near` is at least
 * t_min. Callers cull only where near > far or near > best t: never on equality. */
MACULA_INLINE void box_interval(const TraceRay* r, float lo_x, float lo_y, float lo_z, float hi_x,
                                float hi_y, float hi_z, float* near, float* far) {
    const bool sx = (r->octant & 1u) != 0u, sy = (r->octant & 2u) != 0u,
               sz = (r->octant & 4u) != 0u;
    const float nx = fma(sx ? hi_x : lo_x, r->rx, r->nx), fx = fma(sx ? lo_x : hi_x, r->qx, r->fx);
    const float ny = fma(sy ? hi_y : lo_y, r->ry, r->ny), fy = fma(sy ? lo_y : hi_y, r->qy, r->fy);
    const float nz = fma(sz ? hi_z : lo_z, r->rz, r->nz), fz = fma(sz ? lo_z : hi_z, r->qz, r->fz);
    *near = m_max(m_max(nx, ny), m_max(nz, r->t_min));
    *far = m_min(m_min(fx, fy), fz);
}

MACULA_SHARED_END
#endif
