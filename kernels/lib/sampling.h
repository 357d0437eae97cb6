/* Strata and warps: from hashed numbers to points and directions. */
#ifndef MACULA_LIB_SAMPLING_H
#define MACULA_LIB_SAMPLING_H

#include "lib/random.h"
#include "lib/vector.h"

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
MACULA_ALWAYS_INLINE void stratified_point(uint key, uint sample, uint dimension, uint index,
                                           const Strata* strata, float* u, float* v) {
    const uint bits = random_bits(key, sample, dimension);
    const uint row = (uint)(((float)index + 0.5f) * strata->width);
    const uint column = index - row * strata->columns;
    *u = fma((float)(bits >> 16), 0x1p-16f, (float)column) * strata->width;
    *v = fma((float)(bits & 0xffffu), 0x1p-16f, (float)row) * strata->height;
}

/* Two unit vectors that make an orthonormal basis with the unit vector n (Duff et al. 2017). */
MACULA_ALWAYS_INLINE void basis_around(float3 n, float3* tangent, float3* bitangent) {
    const float sign = n.z < 0.0f ? -1.0f : 1.0f;
    const float a = m_divide(-1.0f, sign + n.z);
    const float b = n.x * n.y * a;
    *tangent = make3(fma(sign * n.x, n.x * a, 1.0f), sign * b, -(sign * n.x));
    *bitangent = make3(b, fma(n.y, n.y * a, sign), -n.y);
}

/* An orthonormal basis about n. */
typedef struct Basis {
    float3 tangent, bitangent, n;
} Basis;

MACULA_ALWAYS_INLINE Basis make_basis(float3 n) {
    Basis basis;
    basis_around(n, &basis.tangent, &basis.bitangent);
    basis.n = n;
    return basis;
}

MACULA_ALWAYS_INLINE float3 in_basis(const Basis* basis, float x, float y, float z) {
    return scale_add3(basis->tangent, x, scale_add3(basis->bitangent, y, basis->n * z));
}

/* Direction about the basis' normal with density cosine / pi. */
MACULA_ALWAYS_INLINE float3 cosine_direction(const Basis* basis, float u, float v) {
    float cosine;
    const float sine = m_sin_cos_pi(v + v, &cosine);
    const float radius = m_sqrt(u);
    return in_basis(basis, radius * cosine, radius * sine, m_sqrt(1.0f - u));
}

/* Direction with uniform density inside the cone of height 1 - cos(half angle) about n. */
MACULA_ALWAYS_INLINE float3 cone_direction(float3 n, float height, float u, float v) {
    const Basis basis = make_basis(n);
    float cosine;
    const float sine = m_sin_cos_pi(v + v, &cosine);
    const float drop = u * height; /* 1 - cos, exact for narrow cones */
    const float radius = m_sqrt(drop * (2.0f - drop));
    return in_basis(&basis, radius * cosine, radius * sine, 1.0f - drop);
}

MACULA_SHARED_END
#endif
