/* Watertight ray/triangle test: Woop, Benthin and Wald 2013, with Kahan's difference of products
 * for the edge functions, whose sign is then right without doubles. Both sides are hit. */
#ifndef MACULA_LIB_TRIANGLE_H
#define MACULA_LIB_TRIANGLE_H

#include "lib/ray.h"
#include "shared/bvh.h"

MACULA_SHARED_BEGIN

typedef struct TraceHit {
    float t, u, v;
    uint triangle;
} TraceHit;

/* a * b - c * d with the sign of the exact value. */
MACULA_INLINE float difference_of_products(float a, float b, float c, float d) {
    const float cd = c * d;
    const float error = fma(-c, d, cd);
    const float difference = fma(a, b, -cd);
    return difference + error;
}

/* Sheared coordinates this small are zero, so that a device that flushes denormals agrees. */
MACULA_INLINE float snap_tiny(float x) {
    return fabs(x) < 0x1p-40f ? 0.0f : x;
}

/* A triangle's box, in its nodes and in its own test, is that of its vertices widened on all sides
 * by this much: MACULA_TRIANGLE_MARGIN * the largest coordinate in size, at least 2^-38 (which also
 * covers snap_tiny). See ray.h. */
#define MACULA_TRIANGLE_MARGIN 0x1p-19f
MACULA_INLINE float triangle_margin(float lo_x, float lo_y, float lo_z, float hi_x, float hi_y,
                                    float hi_z) {
    const float x = m_max(-lo_x, hi_x), y = m_max(-lo_y, hi_y), z = m_max(-lo_z, hi_z);
    return MACULA_TRIANGLE_MARGIN * m_max(m_max(x, y), m_max(z, 0x1p-19f));
}

MACULA_INLINE TraceHit no_hit(float t_max) {
    TraceHit h;
    h.t = t_max;
    h.u = 0.0f;
    h.v = 0.0f;
    h.triangle = MACULA_NO_TRIANGLE;
    return h;
}

/* Conforming devices may differ in which of +0 and -0 a maximum or minimum is, so no result keeps
 * the sign of a zero. */
MACULA_INLINE float unsigned_zero(float x) {
    return as_uint(x) == 0x80000000u ? 0.0f : x;
}

/* The total order of hits: least t, then least triangle id. */
MACULA_INLINE bool is_closer(float t, uint triangle, const TraceHit* best) {
    return t < best->t || (t == best->t && triangle < best->triangle);
}

/* Intersects one triangle; true when the hit lies in the ray's interval and passes the triangle's
 * own box. On true, t (clamped into that box), u and v are set. */
MACULA_INLINE bool intersect_triangle(const TraceRay* r, const float v0x, const float v0y,
                                      const float v0z, const float v1x, const float v1y,
                                      const float v1z, const float v2x, const float v2y,
                                      const float v2z, float* t, float* u, float* v) {
    const float ax = v0x - r->ox, ay = v0y - r->oy, az = v0z - r->oz;
    const float bx = v1x - r->ox, by = v1y - r->oy, bz = v1z - r->oz;
    const float cx = v2x - r->ox, cy = v2y - r->oy, cz = v2z - r->oz;
    const float akz = pick_axis(r->kz, ax, ay, az);
    const float bkz = pick_axis(r->kz, bx, by, bz);
    const float ckz = pick_axis(r->kz, cx, cy, cz);
    const float apx = snap_tiny(fma(-r->sx, akz, pick_axis(r->kx, ax, ay, az)));
    const float apy = snap_tiny(fma(-r->sy, akz, pick_axis(r->ky, ax, ay, az)));
    const float bpx = snap_tiny(fma(-r->sx, bkz, pick_axis(r->kx, bx, by, bz)));
    const float bpy = snap_tiny(fma(-r->sy, bkz, pick_axis(r->ky, bx, by, bz)));
    const float cpx = snap_tiny(fma(-r->sx, ckz, pick_axis(r->kx, cx, cy, cz)));
    const float cpy = snap_tiny(fma(-r->sy, ckz, pick_axis(r->ky, cx, cy, cz)));
    const float wa = difference_of_products(cpx, bpy, cpy, bpx);
    const float wb = difference_of_products(apx, cpy, apy, cpx);
    const float wc = difference_of_products(bpx, apy, bpy, apx);
    const bool any_negative = wa < 0.0f || wb < 0.0f || wc < 0.0f;
    const bool any_positive = wa > 0.0f || wb > 0.0f || wc > 0.0f;
    if (any_negative && any_positive)
        return false;
    const float determinant = (wa + wb) + wc;
    if (determinant == 0.0f)
        return false;
    const float inverse = m_divide(1.0f, determinant);
    const float scaled_t = fma(wa, r->sz * akz, fma(wb, r->sz * bkz, wc * (r->sz * ckz)));
    const float hit_t = scaled_t * inverse;
    if (!(hit_t >= r->t_min))
        return false;
    const float lo_x = m_min(m_min(v0x, v1x), v2x), hi_x = m_max(m_max(v0x, v1x), v2x);
    const float lo_y = m_min(m_min(v0y, v1y), v2y), hi_y = m_max(m_max(v0y, v1y), v2y);
    const float lo_z = m_min(m_min(v0z, v1z), v2z), hi_z = m_max(m_max(v0z, v1z), v2z);
    const float margin = triangle_margin(lo_x, lo_y, lo_z, hi_x, hi_y, hi_z);
    float near, far;
    box_interval(r, lo_x - margin, lo_y - margin, lo_z - margin, hi_x + margin, hi_y + margin,
                 hi_z + margin, &near, &far);
    if (near > far)
        return false;
    const float clamped = m_min(m_max(hit_t, near), far);
    if (!(clamped <= r->t_max))
        return false;
    *t = clamped;
    *u = wb * inverse;
    *v = wc * inverse;
    return true;
}

MACULA_SHARED_END
#endif
