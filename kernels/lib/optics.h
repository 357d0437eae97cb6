/* Reflection and refraction at smooth surfaces (Whitted 1980), with Fresnel's equations for
 * dielectrics. All directions are unit vectors; normals lie on the side from which the light is
 * looked at. */
#ifndef MACULA_LIB_OPTICS_H
#define MACULA_LIB_OPTICS_H

#include "lib/lanes.h"

MACULA_SHARED_BEGIN

/* The part of unpolarised light that the boundary between two dielectrics reflects. `cosine`: of
 * the angle of incidence, 0..1; `eta`: refractive index of this side over that of the other. The
 * refracted ray's cosine goes to *refracted: 0 where all is reflected (total internal reflection).
 */
MACULA_ALWAYS_INLINE Real fresnel_reflectance(Real cosine, Real eta, Real* refracted) {
    const Real one = splat(1.0f), zero = splat(0.0f);
    const Real squared_sine = fma(-cosine, cosine, one);
    const Real squared = fma(-(eta * eta), squared_sine, one);
    const Mask passes = squared > splat(0x1p-40f);
    const Real beyond = m_sqrt(passes ? squared : zero);
    const Real across =
        m_divide(fma(eta, cosine, -beyond), passes ? fma(eta, cosine, beyond) : one);
    const Real along =
        m_divide(fma(eta, beyond, -cosine), passes ? fma(eta, beyond, cosine) : one);
    *refracted = beyond;
    return passes ? 0.5f * fma(across, across, along * along) : one;
}

MACULA_ALWAYS_INLINE Real3 reflected_direction(Real3 direction, Real3 normal, Real cosine) {
    return scale_add3(normal, 2.0f * cosine, direction);
}

/* `refracted`: as fresnel_reflectance() gives it. */
MACULA_ALWAYS_INLINE Real3 refracted_direction(Real3 direction, Real3 normal, Real cosine, Real eta,
                                               Real refracted) {
    return scale_add3(normal, fma(eta, cosine, -refracted), scale3(direction, eta));
}

/* The two rays that go on from a hit, and what they weigh there. */
typedef struct Continuation {
    Real3 reflected, refracted; /* unit */
    Real3 reflected_weight, refracted_weight;
} Continuation;

/* `direction`: of the ray, unit; `behind`: it came from inside, which the winding tells. A material
 * mirrors `reflectivity` at all angles; Fresnel's part of `transmission` is reflected, the rest
 * refracted. The weights thus sum to no more than reflectivity + transmission. The rays leave on
 * the proper side of the triangle even where the shading normal disagrees: they are mirrored out of
 * it or into it. */
MACULA_ALWAYS_INLINE void continue_ray(Real3 direction, Real3 geometric, Real3 shading, Mask behind,
                                       Real3 reflectivity, Real3 transmission,
                                       Real index_of_refraction, Continuation* out) {
    const Real zero = splat(0.0f), one = splat(1.0f);
    const Real seen = -dot3(direction, shading);
    const Mask upright = seen > zero;
    const Real3 normal = select3(upright, shading, geometric);
    const Real cosine = clamped(upright ? seen : -dot3(direction, geometric), zero, one);
    const Real eta = behind ? index_of_refraction : m_divide(one, index_of_refraction);
    Real refracted;
    const Real fresnel = fresnel_reflectance(cosine, eta, &refracted);
    out->reflected_weight = scale_add3(transmission, fresnel, reflectivity);
    out->refracted_weight = scale3(transmission, 1.0f - fresnel);

    const Real3 up = reflected_direction(direction, normal, cosine);
    const Real height = dot3(up, geometric);
    const Real3 raised = scale_add3(geometric, -2.0f * height, up);
    out->reflected = unit3(select3(height < zero, raised, up), geometric);
    const Real3 down = refracted_direction(direction, normal, cosine, eta, refracted);
    const Real rise = dot3(down, geometric);
    const Real3 lowered = scale_add3(geometric, -2.0f * rise, down);
    out->refracted = unit3(select3(rise > zero, lowered, down), neg3(geometric));
}

MACULA_SHARED_END
#endif
