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

/* Correctly rounded reciprocal for normal b with a normal result: a linear seed, three Newton
 * steps of rising order, and the one mantissa (all ones) where Markstein's theorem does not hold.
 */
MACULA_INLINE float m_reciprocal_in_software(float b) {
    const int sign = as_int(b) & (int)0x80000000u;
    const float a = as_float(as_int(b) ^ sign);
    float y = as_float(0x7ef311c7 - as_int(a));
    float error = fma(-a, y, 1.0f);
    y = fma(y, fma(error, error, error), y);
    error = fma(-a, y, 1.0f);
    y = fma(y, fma(error, error, error), y);
    error = fma(-a, y, 1.0f);
    y = fma(y, error, y);
    const int all_ones = (as_int(a) & 0x7fffff) == 0x7fffff ? 1 : 0;
    return as_float((as_int(y) + all_ones) | sign);
}

/* Correctly rounded quotient where neither operands nor result are denormal or infinite. */
MACULA_INLINE float m_divide_in_software(float n, float d) {
    const float y = m_reciprocal_in_software(d);
    float q = n * y;
    q = fma(fma(-d, q, n), y, q);
    return fma(fma(-d, q, n), y, q);
}

/* 1 / sqrt(x) for x > 0, 1 ULP. */
MACULA_INLINE float m_inverse_sqrt(float x) {
    const float half_x = 0.5f * x;
    float y = as_float(0x5f375a86 - (as_int(x) >> 1));
    y = fma(y, fma(-(half_x * y), y, 0.5f), y);
    y = fma(y, fma(-(half_x * y), y, 0.5f), y);
    return fma(y, fma(-(half_x * y), y, 0.5f), y);
}

/* Correctly rounded square root for x = 0 and for normal x > 2^-100. */
MACULA_INLINE float m_sqrt_in_software(float x) {
    const float y = m_inverse_sqrt(x);
    const float half_y = 0.5f * y;
    float s = x * y;
    s = fma(fma(-s, s, x), half_y, s);
    s = fma(fma(-s, s, x), half_y, s);
    return x == 0.0f ? x : s;
}

#if MACULA_CORRECTLY_ROUNDED
MACULA_INLINE float m_divide(float n, float d) {
    return n / d;
}
MACULA_INLINE float m_sqrt(float x) {
    return MACULA_NATIVE_SQRT(x);
}
#else
MACULA_INLINE float m_divide(float n, float d) {
    return m_divide_in_software(n, d);
}
MACULA_INLINE float m_sqrt(float x) {
    return m_sqrt_in_software(x);
}
#endif

/* 2^(high + low) for a result in the normal range (clamped to it); |low| is below an ULP of high.
 * 1 ULP. */
MACULA_INLINE float m_exp2_of_sum(float high, float low) {
    high = high < -126.0f ? -126.0f : (high > 127.99999f ? 127.99999f : high);
    const float whole = rint(high);
    const float f = (high - whole) + low;
    float p = 0x1.448f6ep-13f;
    p = fma(p, f, 0x1.5f4774p-10f);
    p = fma(p, f, 0x1.3b29aap-7f);
    p = fma(p, f, 0x1.c6aed0p-5f);
    p = fma(p, f, 0x1.ebfbe0p-3f);
    p = fma(p, f, 0x1.62e430p-1f);
    p = fma(p, f, 1.0f);
    /* Two factors, since 2^128 alone is not a float though p * 2^128 may be. */
    const int k = (int)whole;
    const int half_k = k >> 1;
    p = p * as_float((half_k + 127) << 23);
    return p * as_float((k - half_k + 127) << 23);
}

MACULA_INLINE float m_exp2(float x) {
    return m_exp2_of_sum(x, 0.0f);
}

/* e^x, 2 ULP for |x| < 80. */
MACULA_INLINE float m_exp(float x) {
    const float high = x * 0x1.715476p+0f;
    const float low = fma(x, 0x1.4ae0bep-26f, fma(x, 0x1.715476p+0f, -high));
    return m_exp2_of_sum(high, low);
}

/* log2(x) for normal x > 0, 2 ULP away from 1 and an absolute 2^-24 near it. */
MACULA_INLINE float m_log2(float x) {
    const int i = as_int(x) - 0x3f2aaaab;
    const float e = (float)(i >> 23);
    const float f = as_float((i & 0x7fffff) + 0x3f2aaaab) - 1.0f;
    float p = -0x1.80af36p-3f;
    p = fma(p, f, 0x1.a03afcp-3f);
    p = fma(p, f, -0x1.66efd4p-3f);
    p = fma(p, f, 0x1.9d1454p-3f);
    p = fma(p, f, -0x1.ecf408p-3f);
    p = fma(p, f, 0x1.27a5c4p-2f);
    p = fma(p, f, -0x1.715328p-2f);
    p = fma(p, f, 0x1.ec6ff4p-2f);
    p = fma(p, f, -0x1.715478p-1f);
    p = fma(p, f, 0x1.715476p+0f);
    return fma(p, f, e);
}

/* x^y for x >= 0 where the result is normal; 0^0 = 1. 2 ULP for y up to 8, 10 ULP up to 1000: the
 * logarithm is carried in two floats, of which a large exponent amplifies the lower one's error. */
MACULA_INLINE float m_pow(float x, float y) {
    const int i = as_int(x) - 0x3f2aaaab;
    const float e = (float)(i >> 23);
    const float f = as_float((i & 0x7fffff) + 0x3f2aaaab) - 1.0f;
    float t = 0x1.68d59ep-3f;
    t = fma(t, f, -0x1.783ff8p-3f);
    t = fma(t, f, 0x1.3c3f5ep-3f);
    t = fma(t, f, -0x1.690b98p-3f);
    t = fma(t, f, 0x1.a6c4d4p-3f);
    t = fma(t, f, -0x1.ecc70ep-3f);
    t = fma(t, f, 0x1.2774c4p-2f);
    t = fma(t, f, -0x1.7153dap-2f);
    t = fma(t, f, 0x1.ec70a2p-2f);
    t = fma(t, f, -0x1.715476p-1f);
    const float sum = fma(f, 0x1.715476p+0f, e);
    float low = fma(f, 0x1.715476p+0f, e - sum);
    low = fma(f, 0x1.4ae0bep-26f, low);
    low = fma(f * f, t, low);
    const float high = sum + low;
    low = (sum - high) + low;
    const float product = y * high;
    const float rest = fma(y, low, fma(y, high, -product));
    const float power = m_exp2_of_sum(product, rest);
    return y == 0.0f ? 1.0f : (x == 0.0f ? 0.0f : power);
}

/* sin(pi x) and cos(pi x) for |x| < 2^22, 1 ULP of 1. */
MACULA_INLINE float m_sin_cos_pi(float x, float* cosine) {
    const float n = rint(x + x);
    const float f = fma(n, -0.5f, x);
    const int quadrant = (int)n;
    const float z = f * f;
    float s = 0x1.4bc6b2p-4f;
    s = fma(s, z, -0x1.32ca98p-1f);
    s = fma(s, z, 0x1.466bbap+1f);
    s = fma(s, z, -0x1.4abbcep+2f);
    s = fma(f, 0x1.921fb6p+1f, fma(f, -0x1.777a5cp-24f, s * (f * z)));
    float c = 0x1.d9c012p-3f;
    c = fma(c, z, -0x1.55c570p+0f);
    c = fma(c, z, 0x1.03c1dcp+2f);
    c = fma(c, z, -0x1.3bd3ccp+2f);
    c = fma(c, z, 1.0f);
    const bool swap = (quadrant & 1) != 0;
    const float sine = swap ? c : s;
    const float cosine_value = swap ? s : c;
    *cosine = as_float(as_int(cosine_value) ^ (((quadrant + 1) & 2) << 30));
    return as_float(as_int(sine) ^ ((quadrant & 2) << 30));
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

/* atan2(y, x) in radians, 3 ULP; atan2(0, 0) = 0 with the sign of y. */
MACULA_INLINE float m_atan2(float y, float x) {
    const float ax = fabs(x), ay = fabs(y);
    const float larger = ax > ay ? ax : ay, smaller = ax > ay ? ay : ax;
    const float a = larger == 0.0f ? 0.0f : m_divide(smaller, larger);
    const float z = a * a;
    float p = -0x1.ca5c66p-10f;
    p = fma(p, z, 0x1.615d98p-7f);
    p = fma(p, z, -0x1.fc6926p-6f);
    p = fma(p, z, 0x1.da0efep-5f);
    p = fma(p, z, -0x1.580c3ep-4f);
    p = fma(p, z, 0x1.c08cb2p-4f);
    p = fma(p, z, -0x1.242086p-3f);
    p = fma(p, z, 0x1.9991e4p-3f);
    p = fma(p, z, -0x1.55553ep-2f);
    float angle = fma(p, a * z, a);
    angle = ay > ax ? 0x1.921fb6p+0f - angle : angle;
    angle = x < 0.0f ? 0x1.921fb6p+1f - angle : angle;
    return copysign(angle, y);
}

MACULA_SHARED_END
#endif
