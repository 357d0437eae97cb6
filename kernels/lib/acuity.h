/* Where the eye can see detail: eccentricities and the foveal function (Weier et al. 2016, section
 * 3.1 and figure 3). */
#ifndef MACULA_LIB_ACUITY_H
#define MACULA_LIB_ACUITY_H

#include "lib/vector.h"

MACULA_SHARED_BEGIN

#define MACULA_DEGREES_OF_RADIAN 57.2957795f
#define MACULA_HALF_TURN_OF_DEGREE 0.00555555556f

/* Eccentricity in degrees of a cosine between a direction and the gaze. */
MACULA_ALWAYS_INLINE float eccentricity_of_cosine(float cosine) {
    return m_acos(clamped(cosine, -1.0f, 1.0f)) * MACULA_DEGREES_OF_RADIAN;
}

/* Cosine of an eccentricity; below every cosine from 180 degrees on. */
MACULA_ALWAYS_INLINE float cosine_of_eccentricity(float degrees) {
    float cosine;
    m_sin_cos_pi(m_min(degrees, 180.0f) * MACULA_HALF_TURN_OF_DEGREE, &cosine);
    return degrees >= 180.0f ? -2.0f : cosine;
}

/* The probability that a pixel is sampled: 1 up to r0 degrees, p_min from r1 degrees on, linear in
 * between. */
MACULA_ALWAYS_INLINE float foveal_probability(float eccentricity, float r0, float r1, float p_min) {
    if (eccentricity <= r0)
        return 1.0f;
    if (eccentricity >= r1)
        return p_min;
    return fma(m_divide(eccentricity - r0, r1 - r0), p_min - 1.0f, 1.0f);
}

MACULA_SHARED_END
#endif
