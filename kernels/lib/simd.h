/* Sixteen lanes: OpenCL C vectors in the idioms that compile to short vector code. No any(), no
 * shuffle with a variable mask and no fmin, which become long sequences on CPUs. */
#ifndef MACULA_LIB_SIMD_H
#define MACULA_LIB_SIMD_H

#include "lib/math_vector.h"

static inline float16 m_min16(float16 a, float16 b) { return a < b ? a : b; }
static inline float16 m_max16(float16 a, float16 b) { return a > b ? a : b; }

/* `mask` is the result of a comparison: each lane 0 or -1. */
static inline bool any_lane16(int16 mask) {
    const long2 halves = as_long2(convert_char16(mask));
    return (halves.x | halves.y) != 0;
}

static inline float least_lane16(float16 v) {
    const float8 a = v.lo < v.hi ? v.lo : v.hi;
    const float4 b = a.lo < a.hi ? a.lo : a.hi;
    const float2 c = b.lo < b.hi ? b.lo : b.hi;
    return c.x < c.y ? c.x : c.y;
}

static inline float greatest_lane16(float16 v) {
    const float8 a = v.lo > v.hi ? v.lo : v.hi;
    const float4 b = a.lo > a.hi ? a.lo : a.hi;
    const float2 c = b.lo > b.hi ? b.lo : b.hi;
    return c.x > c.y ? c.x : c.y;
}

/* Asks the cache for the 64 bytes around p + offset; OpenCL's own prefetch() does nothing in PoCL. */
#if defined(__x86_64__) || defined(__aarch64__)
#define MACULA_FETCH(p, offset)                                                                    \
    __builtin_prefetch((const void *)((ulong)(p) + (offset)))
#else
#define MACULA_FETCH(p, offset)
#endif

/* The number of each lane. */
#define MACULA_LANES16 ((int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))

#endif
