/* The functions of lib/math.h for vectors of one width: included once for each, with MACULA_WIDTH
 * set to it (empty: scalars). All widths give the same bits in every lane. No include guard. */
#define REAL MACULA_OF_WIDTH(float)
#define INT MACULA_OF_WIDTH(int)
#define AS_INT MACULA_OF_WIDTH(as_int)
#define AS_REAL MACULA_OF_WIDTH(as_float)
#define TO_INT MACULA_OF_WIDTH(convert_int)
#define TO_REAL MACULA_OF_WIDTH(convert_float)

MACULA_OVERLOADED REAL m_min(REAL a, REAL b) {
    return a < b ? a : b;
}
MACULA_OVERLOADED REAL m_max(REAL a, REAL b) {
    return a > b ? a : b;
}
MACULA_OVERLOADED REAL clamped(REAL x, REAL lo, REAL hi) {
    return x < lo ? lo : (x > hi ? hi : x);
}

/* Correctly rounded reciprocal for normal b with a normal result: a linear seed, three Newton
 * steps of rising order, and the one mantissa (all ones) where Markstein's theorem does not hold.
 */
MACULA_OVERLOADED REAL m_reciprocal_in_software(REAL b) {
    const INT sign = AS_INT(b) & (INT)((int)0x80000000u);
    const REAL a = AS_REAL(AS_INT(b) ^ sign);
    REAL y = AS_REAL((INT)(0x7ef311c7) - AS_INT(a));
    REAL error = fma(-a, y, (REAL)(1.0f));
    y = fma(y, fma(error, error, error), y);
    error = fma(-a, y, (REAL)(1.0f));
    y = fma(y, fma(error, error, error), y);
    error = fma(-a, y, (REAL)(1.0f));
    y = fma(y, error, y);
    const INT all_ones = (AS_INT(a) & 0x7fffff) == 0x7fffff ? (INT)(1) : (INT)(0);
    return AS_REAL((AS_INT(y) + all_ones) | sign);
}

/* Correctly rounded quotient where neither operands nor result are denormal or infinite. */
MACULA_OVERLOADED REAL m_divide_in_software(REAL n, REAL d) {
    const REAL y = m_reciprocal_in_software(d);
    REAL q = n * y;
    q = fma(fma(-d, q, n), y, q);
    return fma(fma(-d, q, n), y, q);
}

/* 1 / sqrt(x) for x > 0, 1 ULP. */
MACULA_OVERLOADED REAL m_inverse_sqrt(REAL x) {
    const REAL half_x = 0.5f * x;
    REAL y = AS_REAL((INT)(0x5f375a86) - (AS_INT(x) >> 1));
    y = fma(y, fma(-(half_x * y), y, (REAL)(0.5f)), y);
    y = fma(y, fma(-(half_x * y), y, (REAL)(0.5f)), y);
    return fma(y, fma(-(half_x * y), y, (REAL)(0.5f)), y);
}

/* Correctly rounded square root for x = 0 and for normal x > 2^-100. */
MACULA_OVERLOADED REAL m_sqrt_in_software(REAL x) {
    const REAL y = m_inverse_sqrt(x);
    const REAL half_y = 0.5f * y;
    REAL s = x * y;
    s = fma(fma(-s, s, x), half_y, s);
    s = fma(fma(-s, s, x), half_y, s);
    return x == 0.0f ? x : s;
}

#if MACULA_CORRECTLY_ROUNDED
MACULA_OVERLOADED REAL m_divide(REAL n, REAL d) {
    return n / d;
}
MACULA_OVERLOADED REAL m_sqrt(REAL x) {
    return MACULA_NATIVE_SQRT(x);
}
#else
MACULA_OVERLOADED REAL m_divide(REAL n, REAL d) {
    return m_divide_in_software(n, d);
}
MACULA_OVERLOADED REAL m_sqrt(REAL x) {
    return m_sqrt_in_software(x);
}
#endif

/* 2^(high + low) for a result in the normal range (clamped to it); |low| is below an ULP of high.
 * 1 ULP. */
MACULA_OVERLOADED REAL m_exp2_of_sum(REAL high, REAL low) {
    high = high < -126.0f ? (REAL)(-126.0f) : (high > 127.99999f ? (REAL)(127.99999f) : high);
    const REAL whole = rint(high);
    const REAL f = (high - whole) + low;
    REAL p = 0x1.448f6ep-13f;
    p = fma(p, f, (REAL)(0x1.5f4774p-10f));
    p = fma(p, f, (REAL)(0x1.3b29aap-7f));
    p = fma(p, f, (REAL)(0x1.c6aed0p-5f));
    p = fma(p, f, (REAL)(0x1.ebfbe0p-3f));
    p = fma(p, f, (REAL)(0x1.62e430p-1f));
    p = fma(p, f, (REAL)(1.0f));
    /* Two factors, since 2^128 alone is not a float though p * 2^128 may be. */
    const INT k = TO_INT(whole);
    const INT half_k = k >> 1;
    p = p * AS_REAL((half_k + 127) << 23);
    return p * AS_REAL((k - half_k + 127) << 23);
}

/* log2(x) for normal x > 0, 2 ULP away from 1 and an absolute 2^-24 near it. */
MACULA_OVERLOADED REAL m_log2(REAL x) {
    const INT i = AS_INT(x) - 0x3f2aaaab;
    const REAL e = TO_REAL(i >> 23);
    const REAL f = AS_REAL((i & 0x7fffff) + 0x3f2aaaab) - 1.0f;
    REAL p = -0x1.80af36p-3f;
    p = fma(p, f, (REAL)(0x1.a03afcp-3f));
    p = fma(p, f, (REAL)(-0x1.66efd4p-3f));
    p = fma(p, f, (REAL)(0x1.9d1454p-3f));
    p = fma(p, f, (REAL)(-0x1.ecf408p-3f));
    p = fma(p, f, (REAL)(0x1.27a5c4p-2f));
    p = fma(p, f, (REAL)(-0x1.715328p-2f));
    p = fma(p, f, (REAL)(0x1.ec6ff4p-2f));
    p = fma(p, f, (REAL)(-0x1.715478p-1f));
    p = fma(p, f, (REAL)(0x1.715476p+0f));
    return fma(p, f, e);
}

/* x^y for x >= 0 where the result is normal; 0^0 = 1. 2 ULP for y up to 8, 10 ULP up to 1000: the
 * logarithm is carried in two floats, of which a large exponent amplifies the lower one's error. */
MACULA_OVERLOADED REAL m_pow(REAL x, REAL y) {
    const INT i = AS_INT(x) - 0x3f2aaaab;
    const REAL e = TO_REAL(i >> 23);
    const REAL f = AS_REAL((i & 0x7fffff) + 0x3f2aaaab) - 1.0f;
    REAL t = 0x1.68d59ep-3f;
    t = fma(t, f, (REAL)(-0x1.783ff8p-3f));
    t = fma(t, f, (REAL)(0x1.3c3f5ep-3f));
    t = fma(t, f, (REAL)(-0x1.690b98p-3f));
    t = fma(t, f, (REAL)(0x1.a6c4d4p-3f));
    t = fma(t, f, (REAL)(-0x1.ecc70ep-3f));
    t = fma(t, f, (REAL)(0x1.2774c4p-2f));
    t = fma(t, f, (REAL)(-0x1.7153dap-2f));
    t = fma(t, f, (REAL)(0x1.ec70a2p-2f));
    t = fma(t, f, (REAL)(-0x1.715476p-1f));
    const REAL sum = fma(f, (REAL)(0x1.715476p+0f), e);
    REAL low = fma(f, (REAL)(0x1.715476p+0f), e - sum);
    low = fma(f, (REAL)(0x1.4ae0bep-26f), low);
    low = fma(f * f, t, low);
    const REAL high = sum + low;
    low = (sum - high) + low;
    const REAL product = y * high;
    const REAL rest = fma(y, low, fma(y, high, -product));
    const REAL power = m_exp2_of_sum(product, rest);
    return y == 0.0f ? (REAL)(1.0f) : (x == 0.0f ? (REAL)(0.0f) : power);
}

/* sin(pi x) and cos(pi x) for |x| < 2^22, 1 ULP of 1. */
MACULA_OVERLOADED REAL m_sin_cos_pi(REAL x, REAL* cosine) {
    const REAL n = rint(x + x);
    const REAL f = fma(n, (REAL)(-0.5f), x);
    const INT quadrant = TO_INT(n);
    const REAL z = f * f;
    REAL s = 0x1.4bc6b2p-4f;
    s = fma(s, z, (REAL)(-0x1.32ca98p-1f));
    s = fma(s, z, (REAL)(0x1.466bbap+1f));
    s = fma(s, z, (REAL)(-0x1.4abbcep+2f));
    s = fma(f, (REAL)(0x1.921fb6p+1f), fma(f, (REAL)(-0x1.777a5cp-24f), s * (f * z)));
    REAL c = 0x1.d9c012p-3f;
    c = fma(c, z, (REAL)(-0x1.55c570p+0f));
    c = fma(c, z, (REAL)(0x1.03c1dcp+2f));
    c = fma(c, z, (REAL)(-0x1.3bd3ccp+2f));
    c = fma(c, z, (REAL)(1.0f));
    const INT odd = quadrant & 1;
    const REAL sine = odd != 0 ? c : s;
    const REAL cosine_value = odd != 0 ? s : c;
    *cosine = AS_REAL(AS_INT(cosine_value) ^ (((quadrant + 1) & 2) << 30));
    return AS_REAL(AS_INT(sine) ^ ((quadrant & 2) << 30));
}

/* atan2(y, x) in radians, 3 ULP; atan2(0, 0) = 0 with the sign of y. */
MACULA_OVERLOADED REAL m_atan2(REAL y, REAL x) {
    const REAL ax = fabs(x), ay = fabs(y);
    const REAL larger = ax > ay ? ax : ay, smaller = ax > ay ? ay : ax;
    const REAL a = m_divide(smaller, larger == 0.0f ? (REAL)(1.0f) : larger);
    const REAL z = a * a;
    REAL p = -0x1.ca5c66p-10f;
    p = fma(p, z, (REAL)(0x1.615d98p-7f));
    p = fma(p, z, (REAL)(-0x1.fc6926p-6f));
    p = fma(p, z, (REAL)(0x1.da0efep-5f));
    p = fma(p, z, (REAL)(-0x1.580c3ep-4f));
    p = fma(p, z, (REAL)(0x1.c08cb2p-4f));
    p = fma(p, z, (REAL)(-0x1.242086p-3f));
    p = fma(p, z, (REAL)(0x1.9991e4p-3f));
    p = fma(p, z, (REAL)(-0x1.55553ep-2f));
    REAL angle = fma(p, a * z, a);
    angle = ay > ax ? 0x1.921fb6p+0f - angle : angle;
    angle = x < 0.0f ? 0x1.921fb6p+1f - angle : angle;
    return copysign(angle, y);
}

#undef REAL
#undef INT
#undef AS_INT
#undef AS_REAL
#undef TO_INT
#undef TO_REAL
