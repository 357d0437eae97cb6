/* How the samples around a pixel count in its colour, and that colour in the mean over frames
 * (docs/methods/logpolar.md). OpenCL C only. */
#ifndef MACULA_REMAP_WEIGHTS_H
#define MACULA_REMAP_WEIGHTS_H

#include "lib/lanes.h"

/* Sums of weights below this are those of no sample. */
#define LEAST_SUM 1e-20f

/* A lamp does not outshine the dark pixels around it: 1 for what a screen can show, less beyond. */
static inline float weight_of_sample(float3 colour) {
    const float most = m_max(m_max(colour.x, colour.y), m_max(colour.z, 1.0f));
    return m_divide(1.0f, m_min(most, 1e30f));
}

#if MACULA_SMOOTHED

/* (1 - d^2 s)^8: a Gaussian of a quarter of 1 / sqrt(s), but for its tails. */
static inline Real bump(Real d, float s) {
    const Real base = m_max(fma(d, d * splat(-s), splat(1.0f)), splat(0.0f));
    const Real square = base * base, fourth = square * square;
    return fourth * fourth;
}

/* Of three samples, for a place f in [-0.5, 0.5] from the middle one. Frames whose samples lie
 * elsewhere follow: narrower than what a frame by itself needs. */
static inline void tap_weights(Real f, Real weights[3]) {
    for (int i = 0; i < 3; ++i)
        weights[i] = bump(f - splat((float)(i - 1)), 0.4f);
}

/* Along one axis: 1 at the sample, 0.1 between two. */
static inline Real nearness(Real f) {
    return bump(f, 1.0f);
}

#else

/* A quadratic B-spline: a Gaussian of half a sample but for its tails. */
static inline void tap_weights(Real f, Real weights[3]) {
    const Real before = 0.5f - f, after = 0.5f + f;
    weights[0] = 0.5f * (before * before);
    weights[1] = fma(f, -f, splat(0.75f));
    weights[2] = 0.5f * (after * after);
}

static inline Real nearness(Real f) {
    return splat(1.0f);
}

#endif
#endif
