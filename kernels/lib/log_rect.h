/* The log-rectilinear transform (Li et al. 2021): along each axis by itself, between distances from
 * the gaze in pixels and in texels of a smaller buffer. A texel at the distance u of the side's h
 * texels lies
 *   d = max(u, D (exp((u / h)^alpha) - 1) / (e - 1))
 * pixels from the gaze, where the side is D pixels long: near the gaze texels are pixels, and
 * nowhere do two texels share one. */
#ifndef MACULA_LIB_LOG_RECT_H
#define MACULA_LIB_LOG_RECT_H

#include "lib/lanes.h"

MACULA_SHARED_BEGIN

#define MACULA_E_MINUS_1 0x1.b7e152p+0f

/* One axis. A gaze beyond the image's edge is brought to the edge. */
typedef struct RectAxis {
    float gaze, middle;                 /* where the gaze is: pixels, texels */
    float before, behind;               /* pixels on either side of it */
    float texels_before, texels_behind; /* and texels, at most as many */
} RectAxis;

MACULA_ALWAYS_INLINE RectAxis make_rect_axis(float gaze, uint pixels, uint texels) {
    const float size = (float)pixels, count = (float)texels;
    RectAxis axis;
    axis.gaze = clamped(gaze, 0.0f, size);
    /* Each side gets its share of the texels, and the gaze a texel that lies over its pixel. */
    const float share = m_divide(count, size);
    const float least = -floor(count - axis.gaze), most = floor(axis.gaze);
    const float left_out = clamped(rint(fma(-axis.gaze, share, axis.gaze)), least, most);
    axis.middle = axis.gaze - left_out;
    axis.before = axis.gaze;
    axis.behind = size - axis.gaze;
    axis.texels_before = axis.middle;
    axis.texels_behind = count - axis.middle;
    return axis;
}

/* Where a place in pixels lies in texels. */
MACULA_ALWAYS_INLINE Real rect_texel(const RectAxis* axis, float inverse_alpha, Real place) {
    const Real offset = place - axis->gaze, distance = fabs(offset);
    const Mask behind = offset > splat(0.0f);
    const float per_before = m_divide(MACULA_E_MINUS_1, m_max(axis->before, 1e-6f));
    const float per_behind = m_divide(MACULA_E_MINUS_1, m_max(axis->behind, 1e-6f));
    const Real texels = behind ? splat(axis->texels_behind) : splat(axis->texels_before);
    const Real x = distance * (behind ? splat(per_behind) : splat(per_before));
    const Real part = clamped(m_log2(x + 1.0f) * 0x1.62e430p-1f, splat(0.0f), splat(1.0f));
    const Real warped = m_pow(part, splat(inverse_alpha)) * texels;
    const Real texel = distance < warped ? distance : warped;
    return behind ? axis->middle + texel : axis->middle - texel;
}

/* The part of the way from the gaze to the buffer's end, 0..1, of a place in texels. */
MACULA_ALWAYS_INLINE float rect_part(const RectAxis* axis, float texel) {
    const float offset = texel - axis->middle;
    const float texels = offset > 0.0f ? axis->texels_behind : axis->texels_before;
    return m_min(m_divide(fabs(offset), m_max(texels, 1e-6f)), 1.0f);
}

/* Where a texel lies in pixels, and how many of them it takes there. */
typedef struct RectPlace {
    float place, size;
} RectPlace;

/* Of a place in texels; beyond the buffer's ends: the image's. */
MACULA_ALWAYS_INLINE RectPlace rect_place(const RectAxis* axis, float alpha, float texel) {
    const float offset = texel - axis->middle, distance = fabs(offset);
    const bool is_behind = offset > 0.0f;
    const float pixels = is_behind ? axis->behind : axis->before;
    const float texels = is_behind ? axis->texels_behind : axis->texels_before;
    const float part = rect_part(axis, texel);
    const float warped = m_pow(part, alpha), grown = m_exp(warped);
    const float scale = m_divide(pixels, MACULA_E_MINUS_1);
    const float away = (grown - 1.0f) * scale;
    const float slope = m_divide(scale * grown * alpha * warped, m_max(part * texels, 1e-6f));
    const float kept = m_min(m_max(distance, away), pixels);
    RectPlace p;
    p.place = is_behind ? axis->gaze + kept : axis->gaze - kept;
    p.size = away > distance ? m_max(slope, 1.0f) : 1.0f;
    return p;
}

MACULA_SHARED_END
#endif
