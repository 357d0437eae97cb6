/* What the cache knows of a pixel beside its colour (Weier et al. 2016, section 3.4), in eight
 * bytes: rho, the number of samples that its colour is worth, as a float; alpha, the weight of the
 * last one, in 12 bits; t_touched, the frame of the last one, modulo 2^20. rho = 0: no sample yet,
 * the colour is a guess. */
#ifndef MACULA_LIB_CACHE_INFO_H
#define MACULA_LIB_CACHE_INFO_H

#include "lib/math.h"

MACULA_SHARED_BEGIN

#define MACULA_TOUCHED_BITS 20u
#define MACULA_TOUCHED_MASK 0xfffffu

/* The second word; the first one is as_uint(rho). */
MACULA_ALWAYS_INLINE uint pack_touch(float alpha, uint frame) {
    return (uint)(int)rint(alpha * 4095.0f) << MACULA_TOUCHED_BITS | (frame & MACULA_TOUCHED_MASK);
}

MACULA_ALWAYS_INLINE float alpha_of_touch(uint word) {
    return m_divide((float)(word >> MACULA_TOUCHED_BITS), 4095.0f);
}

/* Frames since the last sample, at least 1. */
MACULA_ALWAYS_INLINE uint age_of_touch(uint word, uint frame) {
    const uint age = (frame - word) & MACULA_TOUCHED_MASK;
    return age == 0u ? 1u : age;
}

/* The least weight of a new sample: k_t(dt) of section 3.4 with x_0 and x_1 in powers of two. */
MACULA_ALWAYS_INLINE float least_weight(uint age, float log2_k_min, float log2_k_slope,
                                        float k_max) {
    const float power = fma((float)(age - 1u), log2_k_slope, log2_k_min);
    const float k = m_exp2(power < 0.0f ? power : 0.0f);
    return k < k_max ? k : k_max;
}

/* alpha_t: the larger of 1 / (rho + 1) and k. The paper prints the smaller, against its own text
 * ("k is the minimum possible weight") and Yang et al. 2009. */
MACULA_ALWAYS_INLINE float blending_weight(float rho, float k) {
    const float equal = m_divide(1.0f, rho + 1.0f);
    return equal > k ? equal : k;
}

/* rho_t from alpha_t and rho_{t-1}. */
MACULA_ALWAYS_INLINE float samples_worth(float alpha, float rho) {
    if (!(rho > 0.0f) || alpha >= 1.0f)
        return 1.0f;
    const float rest = 1.0f - alpha;
    return m_divide(1.0f, fma(alpha, alpha, m_divide(rest * rest, rho)));
}

MACULA_SHARED_END
#endif
