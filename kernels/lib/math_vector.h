/* lib/math.h for eight and sixteen lanes: the same bits in every lane as the scalar functions. */
#ifndef MACULA_LIB_MATH_VECTOR_H
#define MACULA_LIB_MATH_VECTOR_H

#include "lib/math.h"

#if MACULA_CORRECTLY_ROUNDED
static inline float8 m_divide8(float8 n, float8 d) {
    return n / d;
}
static inline float16 m_divide16(float16 n, float16 d) {
    return n / d;
}
#else
/* m_divide_in_software of lib/math.h; a comparison's lanes are 0 or -1. */
#define MACULA_DEFINE_DIVIDE(N)                                                                    \
    static inline float##N m_divide##N(float##N n, float##N d) {                                   \
        const int##N sign = as_int##N(d) & (int##N)((int)0x80000000u);                             \
        const float##N a = as_float##N(as_int##N(d) ^ sign);                                       \
        float##N y = as_float##N((int##N)(0x7ef311c7) - as_int##N(a));                             \
        float##N error = fma(-a, y, (float##N)(1.0f));                                             \
        y = fma(y, fma(error, error, error), y);                                                   \
        error = fma(-a, y, (float##N)(1.0f));                                                      \
        y = fma(y, fma(error, error, error), y);                                                   \
        error = fma(-a, y, (float##N)(1.0f));                                                      \
        y = fma(y, error, y);                                                                      \
        const int##N all_ones = (as_int##N(a) & 0x7fffff) == 0x7fffff;                             \
        y = as_float##N((as_int##N(y) - all_ones) | sign);                                         \
        float##N q = n * y;                                                                        \
        q = fma(fma(-d, q, n), y, q);                                                              \
        return fma(fma(-d, q, n), y, q);                                                           \
    }
MACULA_DEFINE_DIVIDE(8)
MACULA_DEFINE_DIVIDE(16)
#undef MACULA_DEFINE_DIVIDE
#endif

static inline float16 m_inverse_sqrt16(float16 x) {
    const float16 half_x = 0.5f * x;
    float16 y = as_float16((int16)(0x5f375a86) - (as_int16(x) >> 1));
    y = fma(y, fma(-(half_x * y), y, (float16)(0.5f)), y);
    y = fma(y, fma(-(half_x * y), y, (float16)(0.5f)), y);
    return fma(y, fma(-(half_x * y), y, (float16)(0.5f)), y);
}

#if MACULA_CORRECTLY_ROUNDED
static inline float16 m_sqrt16(float16 x) {
    return sqrt(x);
}
#else
/* m_sqrt_in_software of lib/math.h. */
static inline float16 m_sqrt16(float16 x) {
    const float16 y = m_inverse_sqrt16(x);
    const float16 half_y = 0.5f * y;
    float16 s = x * y;
    s = fma(fma(-s, s, x), half_y, s);
    s = fma(fma(-s, s, x), half_y, s);
    return x == 0.0f ? x : s;
}
#endif

#endif
