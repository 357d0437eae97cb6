/* Which of the support samples about a pixel look like it: a lag of a dark tile says nothing of the
 * white one beside it. */
#ifndef MACULA_CACHE_LIKENESS_H
#define MACULA_CACHE_LIKENESS_H

#include "lib/math_vector.h"

/* Above 0 for every colour; `green` stands for its brightness. */
MACULA_ALWAYS_INLINE float look_of(float green) {
    return m_max(green, 0.0f) + 0x1p-4f;
}

/* How alike two looks are: their sum for equal ones, 0 where one is a fifth more than the other, or
 * is none. */
MACULA_ALWAYS_INLINE float likeness(float a, float b) {
    return a > 0.0f && b > 0.0f ? m_max(fma(fabs(a - b), -10.0f, a + b), 0.0f) : 0.0f;
}

MACULA_ALWAYS_INLINE float16 likeness16(float16 a, float16 b) {
    const float16 alike = m_max(fma(fabs(a - b), (float16)(-10.0f), a + b), (float16)(0.0f));
    return a > 0.0f && b > 0.0f ? alike : (float16)(0.0f);
}

#endif
