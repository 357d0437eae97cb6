/* Phong's reflection model (Weier et al. 2016, section 3.1):
 *   L = emission + ambient * albedo
 *     + albedo * sum of E + specular * sum of E_n * max(0, r . v)^shininess,
 * where E is what a light sample gives to the surface and E_n what it gives to one that faces the
 * light. As usual with Phong, light colours carry the 1 / pi of a Lambertian surface: a white
 * surface that faces a light of colour 1 at its reference distance has radiance 1. */
#ifndef MACULA_LIB_PHONG_H
#define MACULA_LIB_PHONG_H

#include "lib/lanes.h"

MACULA_SHARED_BEGIN

/* max(0, r . v)^shininess with r the direction to the light mirrored at n. All unit vectors. */
MACULA_ALWAYS_INLINE Real phong_lobe(Real3 n, Real3 to_light, Real3 to_viewer, Real shininess) {
    const Real3 mirrored = scale_add3(n, 2.0f * dot3(n, to_light), neg3(to_light));
    const Real cosine = m_min(dot3(mirrored, to_viewer), splat(1.0f));
    /* Below this the power is far under one part in 2^24 of the peak for any shininess >= 1. */
    const Mask seen = cosine > splat(0x1p-40f);
    return seen ? m_pow(cosine, shininess) : splat(0.0f);
}

MACULA_SHARED_END
#endif
