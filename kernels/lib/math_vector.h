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

#endif
