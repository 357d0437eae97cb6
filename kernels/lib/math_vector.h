/* lib/math.h for eight and sixteen lanes: the same bits in every lane as the scalar functions. */
#ifndef MACULA_LIB_MATH_VECTOR_H
#define MACULA_LIB_MATH_VECTOR_H

#include "lib/math.h"

#define MACULA_WIDTH 8
#include "lib/math_functions.h"
#undef MACULA_WIDTH
#define MACULA_WIDTH 16
#include "lib/math_functions.h"
#undef MACULA_WIDTH

/* m_exp2 of lib/math.h. */
static inline float16 m_exp2_16(float16 x) {
    x = x < -126.0f ? (float16)(-126.0f) : (x > 127.99999f ? (float16)(127.99999f) : x);
    const float16 whole = rint(x), f = x - whole;
    float16 p = 0x1.448f6ep-13f;
    p = fma(p, f, (float16)(0x1.5f4774p-10f));
    p = fma(p, f, (float16)(0x1.3b29aap-7f));
    p = fma(p, f, (float16)(0x1.c6aed0p-5f));
    p = fma(p, f, (float16)(0x1.ebfbe0p-3f));
    p = fma(p, f, (float16)(0x1.62e430p-1f));
    p = fma(p, f, (float16)(1.0f));
    const int16 k = convert_int16(whole), half_k = k >> 1;
    p = p * as_float16((half_k + 127) << 23);
    return p * as_float16((k - half_k + 127) << 23);
}

#endif
