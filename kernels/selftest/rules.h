/* The rules of portable arithmetic (docs/arithmetic.md), each as one expression over three inputs
 * that is evaluated on the device and on the host and must give the same bits. */
#ifndef MACULA_SELFTEST_RULES_H
#define MACULA_SELFTEST_RULES_H

#include "lib/math.h"
#include "lib/triangle.h"

MACULA_SHARED_BEGIN

#define MACULA_RULES 14u

/* a is in (-4, 4), b in [1, 2), c in (-1e3, 1e3). */
MACULA_INLINE void evaluate_rules(float a, float b, float c, uint* out) {
    float cosine;
    const float product = a * b;
    out[0] = as_uint(product + c);         /* a product is rounded before it is added */
    out[1] = as_uint(fma(a, b, c));        /* fma rounds once */
    out[2] = as_uint(fma(a, b, -product)); /* ... even when all but the error cancels */
    out[3] = as_uint(m_divide(c, b));
    out[4] = as_uint(m_sqrt(fabs(c)));
    out[5] = as_uint(rint(c)) ^ as_uint(floor(a));
    out[6] = (uint)(int)c; /* conversion truncates */
    out[7] = as_uint(m_exp2(a * 8.0f));
    out[8] = as_uint(m_log2(b * 1000.0f));
    out[9] = as_uint(m_pow(fabs(a), b * 16.0f));
    out[10] = as_uint(m_sin_cos_pi(a, &cosine));
    out[11] = as_uint(cosine);
    out[12] = as_uint(m_acos(a * 0.25f)) ^ as_uint(m_atan2(a, c));
    out[13] = as_uint(difference_of_products(a, b, b, a + 0x1p-20f)); /* Kahan's edge function */
}

MACULA_SHARED_END
#endif
