/* What a history may look like: this frame's samples around it. OpenCL C only. */
#ifndef MACULA_UPSCALE_NEIGHBOURS_H
#define MACULA_UPSCALE_NEIGHBOURS_H

#include "lib/strip.h"

/* Deviations around the mean that a history may have. */
#define MOVING_REACH 1.5f
#define STILL_REACH 4.0f
/* Deviations of the samples that a pixel is made of, or of those around it, that are no change. */
#define SPREAD_REACH 2.0f

/* Luma and two differences of colours. */
MACULA_ALWAYS_INLINE Real3 luma_of(Real3 c) {
    const Real half_green = splat(0.5f) * c.y, quarter = splat(0.25f);
    const Real outer = fma(quarter, c.x, quarter * c.z);
    return make3(outer + half_green, splat(0.5f) * (c.x - c.z), half_green - outer);
}

MACULA_ALWAYS_INLINE Real3 colour_of(Real3 l) {
    const Real rest = l.x - l.z;
    return make3(rest + l.y, l.x + l.z, rest - l.y);
}

/* Of three by three samples, in luma. */
typedef struct Neighbours {
    Real3 mean, deviation;
} Neighbours;

MACULA_ALWAYS_INLINE Neighbours no_neighbours(void) {
    const Neighbours n = {splat_vector(splat3(0.0f)), splat_vector(splat3(0.0f))};
    return n;
}

/* Sums, of squares too, until weigh_nine(). */
MACULA_ALWAYS_INLINE void add_neighbour(Neighbours* n, Real3 colour) {
    const Real3 luma = luma_of(colour);
    n->mean = add3(n->mean, luma);
    n->deviation = fma3(luma, luma, n->deviation);
}

MACULA_ALWAYS_INLINE Real deviation_of(Real variance) {
    const Mask some = variance > splat(1e-12f);
    return some ? m_sqrt(some ? variance : splat(1.0f)) : splat(0.0f);
}

MACULA_ALWAYS_INLINE void weigh_nine(Neighbours* n) {
    const Real ninth = splat(NINTH);
    n->mean = scale3(n->mean, ninth);
    const Real3 v = fma3(neg3(n->mean), n->mean, scale3(n->deviation, ninth));
    n->deviation = make3(deviation_of(v.x), deviation_of(v.y), deviation_of(v.z));
}

/* A history's colour, drawn towards the mean of the samples until it lies within `reach` deviations
 * (Salvi 2016), or `slack` where that is more. */
MACULA_ALWAYS_INLINE Real3 rectified(const Neighbours* n, Real3 colour, Real reach, Real slack) {
    const Real3 away = sub3(luma_of(colour), n->mean);
    const Real x = m_divide(fabs(away.x), m_max(reach * n->deviation.x, slack));
    const Real y = m_divide(fabs(away.y), m_max(reach * n->deviation.y, slack));
    const Real z = m_divide(fabs(away.z), m_max(reach * n->deviation.z, slack));
    const Real over = m_max(m_max(x, y), m_max(z, splat(1.0f)));
    const Real3 drawn = colour_of(scale_add3(away, m_divide(splat(1.0f), over), n->mean));
    return select3(over > splat(1.0f), drawn, colour);
}

#endif
