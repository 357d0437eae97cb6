/* Equation 1 (Weier et al. 2016, section 3.4) for sixteen pixels: lib/cache_info.h, lane by lane.
 */
#ifndef MACULA_CACHE_BLEND_H
#define MACULA_CACHE_BLEND_H

#include "lib/cache_info.h"
#include "lib/simd.h"
#include "shared/weier.h"

/* What a sample does: its weight, and the cache info after it. */
typedef struct Blend {
    float16 alpha, rho;
    uint16 touch;
} Blend;

/* rho, touch: the cache info before it. A sample of weight 1 is taken as it is. */
MACULA_ALWAYS_INLINE Blend weigh_samples(global const WeierParams* weier, uint now, int16 blended,
                                         float16 rho, uint16 touch) {
    const uint16 since = (now - touch) & MACULA_TOUCHED_MASK;
    const uint16 age = since == 0u ? (uint16)(1u) : since;
    const float16 power = fma(convert_float16(age - 1u), (float16)(weier->log2_k_slope),
                              (float16)(weier->log2_k_min));
    const float16 k = m_min(m_exp2_of_sum(m_min(power, (float16)(0.0f)), (float16)(0.0f)),
                            (float16)(weier->k_max));
    const float16 one = (float16)(1.0f);
    const float16 safe = blended ? rho : one;
    const float16 alpha = blended ? m_max(m_divide(one, safe + 1.0f), k) : one;
    const float16 rest = 1.0f - alpha;
    const float16 part = m_divide(rest * rest, safe > 0.0f ? safe : one);
    const float16 worth = m_divide(one, fma(alpha, alpha, part));
    Blend blend;
    blend.alpha = alpha;
    blend.rho = ((safe > 0.0f) & (alpha < 1.0f)) ? worth : one;
    blend.touch =
        convert_uint16(rint(alpha * 4095.0f)) << MACULA_TOUCHED_BITS | (now & MACULA_TOUCHED_MASK);
    return blend;
}

#endif
