/* The kernel log-polar transform (Mrad 2022, equations 2.2 and 2.3) between distances from the gaze
 * and columns of the buffer, and between angles and rows. The logarithm is that of 1 + r where the
 * thesis has r: the gaze's own pixel then has a place, too, and the transform its inverse. */
#ifndef MACULA_LIB_LOG_POLAR_H
#define MACULA_LIB_LOG_POLAR_H

#include "lib/lanes.h"
#include "shared/log_polar.h"

MACULA_SHARED_BEGIN

/* 0..width for a distance in pixels. */
MACULA_ALWAYS_INLINE Real log_polar_column(MACULA_GLOBAL const LogPolarParams* p,
                                           MACULA_GLOBAL const Fovea* fovea, Real distance) {
    const Real part = m_log2(distance + 1.0f) * fovea->inverse_log_far;
    const Real kept = clamped(part, splat(0.0f), splat(1.0f));
    /* Of the thesis's alpha roots are enough. */
    if (p->inverse_alpha == 0.25f)
        return m_sqrt(m_sqrt(kept)) * (float)p->width;
    return m_pow(kept, splat(p->inverse_alpha)) * (float)p->width;
}

/* The distance in pixels of a column 0..width. */
MACULA_ALWAYS_INLINE float log_polar_distance(MACULA_GLOBAL const LogPolarParams* p,
                                              MACULA_GLOBAL const Fovea* fovea, float column) {
    const float part = m_pow(m_divide(column, (float)p->width), p->alpha);
    return m_exp2(fovea->log_far * part) - 1.0f;
}

/* 0..height for an offset from the gaze in pixels. */
MACULA_ALWAYS_INLINE Real log_polar_row(MACULA_GLOBAL const LogPolarParams* p, Real x, Real y) {
    const Real turn = m_atan2(y, x) * 0x1.45f306p-3f; /* by 2 pi */
    return (turn < 0.0f ? turn + 1.0f : turn) * (float)p->height;
}

/* The direction of a row: its cosine and sine. */
MACULA_ALWAYS_INLINE float log_polar_direction(MACULA_GLOBAL const LogPolarParams* p, float row,
                                               float* cosine) {
    return m_sin_cos_pi(m_divide(row + row, (float)p->height), cosine);
}

/* How much of the disk shows: 1 up to `inner`, 0 from `radius` on. */
MACULA_ALWAYS_INLINE Real part_of_disk(MACULA_GLOBAL const Fovea* fovea, Real distance) {
    const float fade = m_divide(1.0f, m_max(fovea->radius - fovea->inner, 1e-6f));
    const Real t = clamped((fovea->radius - distance) * fade, splat(0.0f), splat(1.0f));
    const Real smooth = t * t * fma(t, splat(-2.0f), splat(3.0f));
    return distance <= fovea->inner ? splat(1.0f) : smooth;
}

/* Pixels that a texel takes along the radius and around it. */
typedef struct TexelSize {
    float along, around;
} TexelSize;

MACULA_ALWAYS_INLINE TexelSize log_polar_texel(MACULA_GLOBAL const LogPolarParams* p,
                                               MACULA_GLOBAL const Fovea* fovea, float column,
                                               float distance) {
    TexelSize size;
    /* d distance / d column = ln 2 (1 + r) log_far alpha x^(alpha - 1) / width. */
    const float x = m_divide(column, (float)p->width);
    const float slope = m_pow(x, p->alpha - 1.0f) * p->alpha * fovea->log_far;
    size.along = m_divide(0x1.62e430p-1f * (distance + 1.0f) * slope, (float)p->width);
    size.around = m_divide(2.0f * MACULA_PI * distance, (float)p->height);
    return size;
}

/* The width in pixels for which the thesis filters textures at a column (equations 4.2 and 4.3):
 * b = 0.3 + 3 smoothstep(u^alpha)^3 levels are a factor of 2^b. Column 0: without phi. */
MACULA_ALWAYS_INLINE float log_polar_thesis_spread(MACULA_GLOBAL const LogPolarParams* p,
                                                   float column) {
    const float u = clamped(m_divide(column, (float)p->width), 0.0f, 1.0f);
    const float t = m_pow(u, p->alpha);
    const float step = t * t * fma(t, -2.0f, 3.0f);
    return m_exp2(fma(3.0f * step, step * step, 0.3f));
}

MACULA_SHARED_END
#endif
