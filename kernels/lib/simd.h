/* Eight and sixteen lanes: OpenCL C vectors in the idioms that compile to short vector code. No
 * any(), no shuffle with a variable mask and no fmin, which become long sequences on CPUs. */
#ifndef MACULA_LIB_SIMD_H
#define MACULA_LIB_SIMD_H

#include "lib/math_vector.h"

/* `mask` is the result of a comparison: each lane 0 or -1. Where there are mask registers, they say
 * at once what elsewhere is put together from bytes. */
#if defined(__AVX512VL__) && defined(__AVX512DQ__)
typedef int Native8 __attribute__((vector_size(32)));
typedef int Native16 __attribute__((vector_size(64)));
#define MACULA_NATIVE8(v) __builtin_astype(v, Native8)
#define MACULA_NATIVE16(v) __builtin_astype(v, Native16)

static inline bool any_lane16(int16 mask) {
    return (ushort)__builtin_ia32_cvtd2mask512(MACULA_NATIVE16(mask)) != 0;
}

/* Bit n is set where lane n of such a mask is not 0. */
static inline uint bits_of_lanes16(int16 mask) {
    return (ushort)__builtin_ia32_cvtd2mask512(MACULA_NATIVE16(mask));
}

static inline uint bits_of_lanes8(int8 mask) {
    return (uchar)__builtin_ia32_cvtd2mask256(MACULA_NATIVE8(mask));
}
#else
static inline bool any_lane16(int16 mask) {
    const long2 halves = as_long2(convert_char16(mask));
    return (halves.x | halves.y) != 0;
}

/* Bit n is set where lane n of such a mask is not 0. */
static inline uint bits_of_lanes16(int16 mask) {
    const ulong2 bytes = as_ulong2(convert_char16(mask)) & 0x8040201008040201ul;
    const ulong2 bits = bytes * 0x0101010101010101ul >> 56;
    return (uint)(bits.x | bits.y << 8);
}

static inline uint bits_of_lanes8(int8 mask) {
    const ulong bytes = as_ulong(convert_char8(mask)) & 0x8040201008040201ul;
    return (uint)(bytes * 0x0101010101010101ul >> 56);
}
#endif

static inline uint first_lane(uint bits) {
    return popcount((bits & -bits) - 1u);
}

static inline float greatest_lane16(float16 v) {
    const float8 a = v.lo > v.hi ? v.lo : v.hi;
    const float4 b = a.lo > a.hi ? a.lo : a.hi;
    const float2 c = b.lo > b.hi ? b.lo : b.hi;
    return c.x > c.y ? c.x : c.y;
}

/* The least lanes of eight vectors, folded together: half of a vector is left of each after the
 * first step, a quarter after the second, and so on. */
static inline float16 fold_halves(float16 a, float16 b) {
    return m_min((float16)(a.lo, b.lo), (float16)(a.hi, b.hi));
}

static inline float16 fold_quarters(float16 a, float16 b) {
    return m_min((float16)(a.s0123, a.s89ab, b.s0123, b.s89ab),
                 (float16)(a.s4567, a.scdef, b.s4567, b.scdef));
}

static inline float16 fold_eighths(float16 a, float16 b) {
    return m_min((float16)(a.s01, a.s45, a.s89, a.scd, b.s01, b.s45, b.s89, b.scd),
                 (float16)(a.s23, a.s67, a.sab, a.sef, b.s23, b.s67, b.sab, b.sef));
}

MACULA_ALWAYS_INLINE float8 least_lanes16(const float16 v[8]) {
    const float16 a = fold_quarters(fold_halves(v[0], v[1]), fold_halves(v[2], v[3]));
    const float16 b = fold_quarters(fold_halves(v[4], v[5]), fold_halves(v[6], v[7]));
    const float16 c = fold_eighths(a, b);
    return c.even < c.odd ? c.even : c.odd;
}

/* Asks the cache for the 64 bytes at p + offset; OpenCL's own prefetch() does nothing in PoCL. */
#if defined(__x86_64__) || defined(__aarch64__)
#define MACULA_FETCH(p, offset) __builtin_prefetch((const void*)((ulong)(p) + (offset)))
#define MACULA_FETCH_TO_WRITE(p, offset) __builtin_prefetch((const void*)((ulong)(p) + (offset)), 1)
#else
#define MACULA_FETCH(p, offset)
#define MACULA_FETCH_TO_WRITE(p, offset)
#endif

/* Lane lane[i] mod 8 of v in lane i, and the lanes of v that `keep` marks side by side from lane 0
 * on; what follows them is of no meaning. Instructions of AVX-512, which compilers do not find by
 * themselves; elsewhere a store of each lane. */
#if defined(__AVX512VL__) && defined(__AVX512DQ__)
static inline int8 permuted8(int8 v, int8 lane) {
    return __builtin_astype(__builtin_ia32_permvarsi256(MACULA_NATIVE8(v), MACULA_NATIVE8(lane)),
                            int8);
}

static inline int8 compressed8(int8 v, int8 keep) {
    return __builtin_astype(
        __builtin_ia32_compresssi256_mask(MACULA_NATIVE8(v), MACULA_NATIVE8((int8)(0)),
                                          __builtin_ia32_cvtd2mask256(MACULA_NATIVE8(keep))),
        int8);
}
#else
static inline int8 permuted8(int8 v, int8 lane) {
    int from[8], of[8], to[8];
    vstore8(v, 0, from);
    vstore8(lane, 0, of);
    for (uint i = 0u; i < 8u; ++i)
        to[i] = from[of[i] & 7];
    return vload8(0, to);
}

static inline int8 compressed8(int8 v, int8 keep) {
    int from[8], kept[8], to[8] = {0};
    vstore8(v, 0, from);
    vstore8(keep, 0, kept);
    uint count = 0u;
    for (uint i = 0u; i < 8u; ++i)
        if (kept[i] != 0)
            to[count++] = from[i];
    return vload8(0, to);
}
#endif

/* Lane lane[i] mod 16 of v in lane i. */
#if defined(__AVX512F__)
typedef float NativeFloat16 __attribute__((vector_size(64)));
typedef int NativeInt16 __attribute__((vector_size(64)));

static inline float16 permuted16(float16 v, int16 lane) {
    return __builtin_astype(
        __builtin_ia32_permvarsf512(__builtin_astype(v, NativeFloat16),
                                    __builtin_astype(lane, NativeInt16)),
        float16);
}
#else
static inline float16 permuted16(float16 v, int16 lane) {
    float from[16], to[16];
    int of[16];
    vstore16(v, 0, from);
    vstore16(lane, 0, of);
    for (uint i = 0u; i < 16u; ++i)
        to[i] = from[of[i] & 15];
    return vload16(0, to);
}
#endif

static inline int8 exchanged8(int8 v, int8 other, int8 takes_greater) {
    const int8 less = v < other ? v : other, greater = v < other ? other : v;
    return takes_greater ? greater : less;
}

/* The lanes in falling order (Batcher 1968: bitonic sorting). */
static inline int8 sorted8(int8 v) {
    const int8 first_of_2 = (int8)(-1, 0, -1, 0, -1, 0, -1, 0);
    const int8 half_of_4 = (int8)(-1, -1, 0, 0, -1, -1, 0, 0);
    const int8 half_of_8 = (int8)(-1, -1, -1, -1, 0, 0, 0, 0);
    v = exchanged8(v, v.s10325476, first_of_2);
    v = exchanged8(v, v.s32107654, half_of_4);
    v = exchanged8(v, v.s10325476, first_of_2);
    v = exchanged8(v, v.s76543210, half_of_8);
    v = exchanged8(v, v.s23016745, half_of_4);
    return exchanged8(v, v.s10325476, first_of_2);
}

/* The number of each lane. */
#define MACULA_LANES8 ((int8)(0, 1, 2, 3, 4, 5, 6, 7))
#define MACULA_LANES16 ((int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))

#endif
