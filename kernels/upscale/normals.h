/* Normals in one float each: octahedral (Meyer et al. 2010, "On Floating-Point Normal Vectors"),
 * two whole numbers of 0..2046 in one; and sets of normals in one float each. OpenCL C only. */
#ifndef MACULA_UPSCALE_NORMALS_H
#define MACULA_UPSCALE_NORMALS_H

#include "lib/lanes.h"

#define NORMAL_STEPS 1023.0f
#define NORMAL_STEP 0x1.004010p-10f
#define NORMAL_BASE 2048.0f
/* The square of the cosine from which on two surfaces face alike: 45 degrees. */
#define ALIKE_SQUARED 0.5f

static inline float pack_normal(float3 n) {
    const float size = fabs(n.x) + fabs(n.y) + fabs(n.z);
    if (!(size > 1e-6f))
        return 0.0f;
    const float share = m_divide(1.0f, size);
    float a = n.x * share, b = n.y * share;
    if (n.z < 0.0f) {
        const float folded = copysign(fma(-fabs(n.y), share, 1.0f), a);
        b = copysign(fma(-fabs(n.x), share, 1.0f), b);
        a = folded;
    }
    const float x = rint(fma(a, NORMAL_STEPS, NORMAL_STEPS));
    const float y = rint(fma(b, NORMAL_STEPS, NORMAL_STEPS));
    return fma(x, NORMAL_BASE, y + 1.0f);
}

/* Of any length; of a number that is no normal: any vector. */
MACULA_ALWAYS_INLINE Real3 unpacked_normal(Real packed) {
    const Real kept = clamped(packed - splat(1.0f), splat(0.0f), splat(0x1p22f));
    const Real high = floor(kept * splat(0x1p-11f));
    const Real low = fma(high, splat(-NORMAL_BASE), kept);
    const Real one = splat(1.0f);
    const Real a = fma(high, splat(NORMAL_STEP), -one);
    const Real b = fma(low, splat(NORMAL_STEP), -one);
    const Real z = (one - fabs(a)) - fabs(b);
    const Mask folded = z < splat(0.0f);
    const Real x = folded ? copysign(one - fabs(b), a) : a;
    const Real y = folded ? copysign(one - fabs(a), b) : b;
    return make3(x, y, z);
}

/* Two packed normals. One that is not known is like every other. */
MACULA_ALWAYS_INLINE Mask face_alike(Real packed, Real other) {
    const Real3 a = unpacked_normal(packed), b = unpacked_normal(other);
    const Real cosine = dot3(a, b), sizes = dot3(a, a) * dot3(b, b);
    const Mask known = (packed >= splat(1.0f)) & (other >= splat(1.0f));
    const Mask apart = (cosine <= splat(0.0f)) | (cosine * cosine < splat(ALIKE_SQUARED) * sizes);
    return !(known & apart);
}

/* A set of normals: a bit for each eighth of each axis near which one of them ends, a whole number
 * below 2^24. Sets are united by their bits. Each normal has three bits an axis: those that share
 * none along some axis are 29 degrees apart or more, and none that are 82 degrees apart share them
 * along all three. */
#define ALL_NORMALS 0xffffffu

MACULA_ALWAYS_INLINE Uint near_eighths(Real component) {
    const Real at = clamped(fma(component, splat(4.0f), splat(4.0f)), splat(0.0f), splat(7.0f));
    return (splat_uint(7u) << to_uint(at)) >> 1u & 255u;
}

/* Of a normal of any length; of none: all. */
MACULA_ALWAYS_INLINE Uint normal_set(Real3 n) {
    const Real square = dot3(n, n), one = splat(1.0f);
    const Mask known = square > splat(1e-12f);
    const Real3 unit = scale3(n, m_divide(one, m_sqrt(known ? square : one)));
    const Uint x = near_eighths(unit.x), y = near_eighths(unit.y), z = near_eighths(unit.z);
    return known ? x | y << 8u | z << 16u : splat_uint(ALL_NORMALS);
}

/* Of what faced the viewer: the negative of a set, or a packed normal; of anything else: all. */
MACULA_ALWAYS_INLINE Uint facing_set(Real facing) {
    const Real one = splat(1.0f), all = splat((float)ALL_NORMALS);
    const Mask is_set = (facing <= -one) & (facing >= -all);
    const Mask is_normal = (facing >= one) & (facing <= all);
    Uint set = is_set ? to_uint(is_set ? -facing : one) : splat_uint(ALL_NORMALS);
    if (any_lane(is_normal))
        set = is_normal ? normal_set(unpacked_normal(facing)) : set;
    return set;
}

/* Some normal of the one may be some normal of the other. */
MACULA_ALWAYS_INLINE Mask sets_meet(Uint a, Uint b) {
    const Uint both = a & b;
    return ((both & 0xffu) != 0u) & ((both & 0xff00u) != 0u) & ((both & 0xff0000u) != 0u);
}

#endif
