/* Strata and warps: from hashed numbers to points and directions. */
#ifndef MACULA_LIB_SAMPLING_H
#define MACULA_LIB_SAMPLING_H

#include "lib/random.h"
#include "lib/vector.h"

MACULA_SHARED_BEGIN

/* Columns of the most nearly square grid with exactly `count` cells, count >= 1: the least divisor
 * whose square is at least the count. 16: 4 x 4, 8: 4 x 2, a prime: one row. */
MACULA_INLINE uint strata_columns(uint count) {
    uint columns = 1u;
    while (columns * columns < count || count % columns != 0u)
        ++columns;
    return columns;
}

/* A point of [0, 1)^2 in cell `index` of a grid of columns x (count / columns) cells. All pixels of
 * a packet draw from the same cell, which keeps their rays coherent. `sample` counts the draws of
 * one pixel over all of its samples. */
MACULA_INLINE void stratified_point(uint key, uint sample, uint dimension, uint index, uint columns,
                                    uint count, float* u, float* v) {
    const uint rows = count / columns;
    const float x = (float)(index % columns) + random_unit(key, sample, dimension);
    const float y = (float)(index / columns) + random_unit(key, sample, dimension + 1u);
    *u = m_min(m_divide(x, (float)columns), 0x1.fffffep-1f);
    *v = m_min(m_divide(y, (float)rows), 0x1.fffffep-1f);
}

/* Two unit vectors that make an orthonormal basis with the unit vector n (Duff et al. 2017). */
MACULA_INLINE void basis_around(float3 n, float3* tangent, float3* bitangent) {
    const float sign = n.z < 0.0f ? -1.0f : 1.0f;
    const float a = m_divide(-1.0f, sign + n.z);
    const float b = n.x * n.y * a;
    *tangent = make3(fma(sign * n.x, n.x * a, 1.0f), sign * b, -(sign * n.x));
    *bitangent = make3(b, fma(n.y, n.y * a, sign), -n.y);
}

/* x * tangent + y * bitangent + z * n. */
MACULA_INLINE float3 in_basis_of(float3 n, float x, float y, float z) {
    float3 tangent, bitangent;
    basis_around(n, &tangent, &bitangent);
    return scale_add3(tangent, x, scale_add3(bitangent, y, n * z));
}

/* Direction about the unit vector n with density cosine / pi. */
MACULA_INLINE float3 cosine_direction(float3 n, float u, float v) {
    float cosine;
    const float sine = m_sin_cos_pi(v + v, &cosine);
    const float radius = m_sqrt(u);
    return in_basis_of(n, radius * cosine, radius * sine, m_sqrt(1.0f - u));
}

/* Direction with uniform density inside the cone of height 1 - cos(half angle) about n. */
MACULA_INLINE float3 cone_direction(float3 n, float height, float u, float v) {
    float cosine;
    const float sine = m_sin_cos_pi(v + v, &cosine);
    const float drop = u * height; /* 1 - cos, exact for narrow cones */
    const float radius = m_sqrt(drop * (2.0f - drop));
    return in_basis_of(n, radius * cosine, radius * sine, 1.0f - drop);
}

MACULA_SHARED_END
#endif
