/* Strata and warps: from hashed numbers to points and directions. */
#ifndef MACULA_LIB_SAMPLING_H
#define MACULA_LIB_SAMPLING_H

#include "lib/lanes.h"

MACULA_SHARED_BEGIN

/* Columns of the most nearly square grid with exactly `count` cells, count >= 1: the least divisor
 * whose square is at least the count. 16: 4 x 4, 8: 4 x 2, a prime: one row. */
MACULA_ALWAYS_INLINE uint strata_columns(uint count) {
    uint columns = 1u;
    while (columns * columns < count || count % columns != 0u)
        ++columns;
    return columns;
}

/* The grid of strata of a unit square. */
typedef struct Strata {
    uint columns;
    float width, height; /* of a cell */
} Strata;

MACULA_ALWAYS_INLINE Strata make_strata(uint columns, uint count) {
    Strata strata;
    strata.columns = columns;
    strata.width = m_divide(1.0f, (float)columns);
    strata.height = m_divide((float)columns, (float)count);
    return strata;
}

/* A point of [0, 1)^2 in cell `index`, below 2^20, from the two halves of one hash. All pixels of a
 * packet draw from the same cell, which keeps their rays coherent. `sample` counts the draws of one
 * pixel over all of its samples. */
MACULA_ALWAYS_INLINE void stratified_point(Uint key, Uint sample, uint dimension, Uint index,
                                           const Strata* strata, Real* u, Real* v) {
    const Uint bits = random_bits(key, sample, dimension);
    const Uint row = to_uint((uint_to_real(index) + 0.5f) * strata->width);
    const Uint column = index - row * strata->columns;
    const Real step = splat(0x1p-16f);
    *u = fma(uint_to_real(bits >> 16), step, uint_to_real(column)) * strata->width;
    *v = fma(uint_to_real(bits & 0xffffu), step, uint_to_real(row)) * strata->height;
}

/* An orthonormal basis about n (Duff et al. 2017). */
typedef struct Basis {
    Real3 tangent, bitangent, n;
} Basis;

/* n: of unit length. */
MACULA_ALWAYS_INLINE Basis make_basis(Real3 n) {
    const Real sign = n.z < splat(0.0f) ? splat(-1.0f) : splat(1.0f);
    const Real a = m_divide(splat(-1.0f), sign + n.z);
    const Real b = n.x * n.y * a;
    Basis basis;
    basis.tangent = make3(fma(sign * n.x, n.x * a, splat(1.0f)), sign * b, -(sign * n.x));
    basis.bitangent = make3(b, fma(n.y, n.y * a, sign), -n.y);
    basis.n = n;
    return basis;
}

MACULA_ALWAYS_INLINE Real3 in_basis(const Basis* basis, Real x, Real y, Real z) {
    return scale_add3(basis->tangent, x, scale_add3(basis->bitangent, y, scale3(basis->n, z)));
}

/* Direction about the basis' normal with density cosine / pi. */
MACULA_ALWAYS_INLINE Real3 cosine_direction(const Basis* basis, Real u, Real v) {
    Real cosine;
    const Real sine = m_sin_cos_pi(v + v, &cosine);
    const Real radius = m_sqrt(u);
    return in_basis(basis, radius * cosine, radius * sine, m_sqrt(1.0f - u));
}

/* Direction with uniform density inside the cone of height 1 - cos(half angle) about n. */
MACULA_ALWAYS_INLINE Real3 cone_direction(Real3 n, Real height, Real u, Real v) {
    const Basis basis = make_basis(n);
    Real cosine;
    const Real sine = m_sin_cos_pi(v + v, &cosine);
    const Real drop = u * height; /* 1 - cos, exact for narrow cones */
    const Real radius = m_sqrt(drop * (2.0f - drop));
    return in_basis(&basis, radius * cosine, radius * sine, 1.0f - drop);
}

MACULA_SHARED_END
#endif
