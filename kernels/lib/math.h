/* Portable elementary functions: the same bits on every OpenCL device and on the host, since they
 * are made of + - * fma, integer operations and selects alone. Accuracies (in ULP, measured by
 * tests/unit/math_test.cpp) stand beside each. Inputs outside the stated range give a finite but
 * unspecified result; none of these functions returns NaN for a finite argument in range. */
#ifndef MACULA_LIB_MATH_H
#define MACULA_LIB_MATH_H

#include "shared/language.h"

#ifdef __OPENCL_VERSION__
/* 1 when the device divides and roots correctly rounded (CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT and
 * the matching build option); the host always does. */
#ifndef MACULA_CORRECTLY_ROUNDED
#define MACULA_CORRECTLY_ROUNDED 0
#endif
#define MACULA_NATIVE_SQRT sqrt
#else
#define MACULA_CORRECTLY_ROUNDED 1
#define MACULA_NATIVE_SQRT std::sqrt
#endif

MACULA_SHARED_BEGIN

#define MACULA_PI 0x1.921fb6p+1f

#define MACULA_WIDTH
#include "lib/math_functions.h"
#undef MACULA_WIDTH

MACULA_INLINE float m_exp2(float x) {
    return m_exp2_of_sum(x, 0.0f);
}

/* e^x, 2 ULP for |x| < 80. */
MACULA_INLINE float m_exp(float x) {
    const float high = x * 0x1.715476p+0f;
    const float low = fma(x, 0x1.4ae0bep-26f, fma(x, 0x1.715476p+0f, -high));
    return m_exp2_of_sum(high, low);
}

/* acos(x) in radians for |x| <= 1, 2 ULP. */
MACULA_INLINE float m_acos(float x) {
    const float a = fabs(x);
    const bool large = a > 0.5f;
    const float half_rest = fma(a, -0.5f, 0.5f);
    const float z = large ? half_rest : a * a;
    const float t = large ? m_sqrt(half_rest) : a;
    float p = 0x1.59cc7ap-5f;
    p = fma(p, z, 0x1.8bb556p-6f);
    p = fma(p, z, 0x1.748a2ap-5f);
    p = fma(p, z, 0x1.33016ap-4f);
    p = fma(p, z, 0x1.5555cap-3f);
    const float arcsine = fma(p, t * z, t);
    const float of_large = x < 0.0f ? fma(-2.0f, arcsine, 0x1.921fb6p+1f) : arcsine + arcsine;
    const float of_small = 0x1.921fb6p+0f - ((x < 0.0f ? -arcsine : arcsine) + 0x1.777a5cp-25f);
    return large ? of_large : of_small;
}

MACULA_SHARED_END
#endif
