/* The lanes of a work-item: how many rays or points it works on at once. What is written in Real,
 * Int, Uint, Mask and Real3 is compiled for one lane (the host, and devices that run a work-item a
 * lane themselves) and for sixteen (CPUs). The bits of a lane are the same in both.
 *
 * In such code conditions select: where one lane would branch, all lanes compute both sides, unless
 * any_lane() says that nobody wants one of them. Indices must be valid in every lane. */
#ifndef MACULA_LIB_LANES_H
#define MACULA_LIB_LANES_H

#include "lib/random.h"
#include "lib/vector.h"

#ifndef MACULA_LANES
#define MACULA_LANES 1
#endif

#if MACULA_LANES == 1

MACULA_SHARED_BEGIN

typedef float Real;
typedef int Int;
typedef uint Uint;
typedef bool Mask;
typedef float3 Real3;

MACULA_INLINE Real splat(float x) {
    return x;
}
MACULA_INLINE Uint splat_uint(uint x) {
    return x;
}
MACULA_INLINE Int splat_int(int x) {
    return x;
}
MACULA_INLINE Real3 splat_vector(float3 v) {
    return v;
}
MACULA_INLINE bool any_lane(Mask mask) {
    return mask;
}
MACULA_INLINE Int to_int(Real x) {
    return (int)x;
}
MACULA_INLINE Uint to_uint(Real x) {
    return (uint)x;
}
MACULA_INLINE Real uint_to_real(Uint x) {
    return (float)x;
}
MACULA_INLINE Uint int_to_uint(Int x) {
    return (uint)x;
}

/* The bits of a word that is no number. */
MACULA_INLINE Uint real_bits(Real x) {
    return as_uint(x);
}

/* table[index]member in each lane, for scalars of that type. */
#define MACULA_GATHER(type, table, index, member) ((table)[index] member)

MACULA_SHARED_END

#else /* sixteen */

#include "lib/random_vector.h"
#include "lib/simd.h"
#include "lib/vector16.h"

typedef float16 Real;
typedef int16 Int;
typedef uint16 Uint;
typedef int16 Mask;
typedef Vector16 Real3;

MACULA_INLINE Real splat(float x) {
    return (float16)(x);
}
MACULA_INLINE Uint splat_uint(uint x) {
    return (uint16)(x);
}
MACULA_INLINE Int splat_int(int x) {
    return (int16)(x);
}
MACULA_ALWAYS_INLINE Real3 splat_vector(float3 v) {
    return spread16(v);
}
MACULA_ALWAYS_INLINE bool any_lane(Mask mask) {
    return any_lane16(mask);
}
MACULA_ALWAYS_INLINE Int to_int(Real x) {
    return convert_int16(x);
}
MACULA_ALWAYS_INLINE Uint to_uint(Real x) {
    return convert_uint16(x);
}
MACULA_ALWAYS_INLINE Real uint_to_real(Uint x) {
    return convert_float16(x);
}
MACULA_ALWAYS_INLINE Uint int_to_uint(Int x) {
    return as_uint16(x);
}

MACULA_ALWAYS_INLINE Uint real_bits(Real x) {
    return as_uint16(x);
}

#define MACULA_GATHER(type, table, index, member)                                                  \
    ((type##16)(                                                                                   \
        (table)[(index).s0] member, (table)[(index).s1] member, (table)[(index).s2] member,        \
        (table)[(index).s3] member, (table)[(index).s4] member, (table)[(index).s5] member,        \
        (table)[(index).s6] member, (table)[(index).s7] member, (table)[(index).s8] member,        \
        (table)[(index).s9] member, (table)[(index).sa] member, (table)[(index).sb] member,        \
        (table)[(index).sc] member, (table)[(index).sd] member, (table)[(index).se] member,        \
        (table)[(index).sf] member))

#endif
#endif
