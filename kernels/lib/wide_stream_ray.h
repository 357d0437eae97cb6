/* The rays of a stream, each a row of sixteen floats: the length of a cache line and of a vector. A
 * vector operation works on two rays at once, with eight boxes or triangles for each. OpenCL C
 * only. */
#ifndef MACULA_LIB_WIDE_STREAM_RAY_H
#define MACULA_LIB_WIDE_STREAM_RAY_H

#include "lib/plain_hit.h"
#include "lib/ray16.h"
#include "lib/traverse_wide8.h"
#include "lib/wide_push.h"

/* Places in a row. */
#define MACULA_ROW_R 0u     /* TraceRay.rx, ry, rz */
#define MACULA_ROW_N 3u     /* TraceRay.nx, ny, nz */
#define MACULA_ROW_T_MAX 6u /* the best t so far */
#define MACULA_ROW_T_MIN 7u
#define MACULA_ROW_O 8u      /* the origin along kx, ky and kz */
#define MACULA_ROW_S 11u     /* TraceRay.sx, sy, sz */
#define MACULA_ROW_BIT 14u   /* the bits of 1u << the ray's number in its chunk */
#define MACULA_ROW_INDEX 15u /* the bits of its number in the queue, less the work-item's first */

typedef union StreamRay {
    float16 row;
    float value[16];
} StreamRay;

/* For two rows, value `place` (s0 to sf) of the first eight times, then that of the second. */
#define MACULA_OF_BOTH(a, b, place) ((float16)((float8)((a).place), (float8)((b).place)))

/* Eight values for each of two rays. */
static inline float16 twice(float8 v) {
    return (float16)(v, v);
}

/* The numbers of two rays of a mask that is not 0, or twice that of its last one. */
typedef struct RayPair {
    uint first, second;
} RayPair;

static inline RayPair next_pair(uint* rays) {
    RayPair p;
    p.first = first_bit(*rays);
    const uint rest = *rays & (*rays - 1u);
    p.second = rest != 0u ? first_bit(rest) : p.first;
    *rays = rest & (rest - 1u);
    return p;
}

/* What the rays of a traversal have in common. */
typedef struct StreamClass {
    uint octant;
    uint kx, ky, kz;
    float pad[3]; /* what far planes are moved by, see far_plane8 */
    bool plain;   /* hits are plain (lib/plain_hit.h) unless their determinant is small */
} StreamClass;

/* Classes of rays by octant and dominant axis. */
#define MACULA_STREAM_CLASSES 24u

/* The greatest sizes of components: of the rays' origins and directions, and of the mesh's planes.
 */
typedef struct StreamSizes {
    float reach, speed, mesh;
} StreamSizes;

static inline StreamClass stream_class(uint index, const StreamSizes* sizes) {
    StreamClass c;
    c.octant = index / 3u;
    c.kz = index % 3u;
    c.kx = c.kz == 2u ? 0u : c.kz + 1u;
    c.ky = c.kx == 2u ? 0u : c.kx + 1u;
    const float pad = fma(4.0f * MACULA_RAY_MARGIN, sizes->reach, 0x1p-19f * sizes->mesh);
    for (uint axis = 0u; axis < 3u; ++axis)
        c.pad[axis] = ((c.octant >> axis) & 1u) != 0u ? -pad : pad;
    c.plain = m_max(m_max(sizes->reach, sizes->speed), sizes->mesh) <= MACULA_PLAIN_SIZE;
    return c;
}

static inline float16 zip_lo(float16 a, float16 b) {
    return (float16)(a.lo, b.lo).s08192a3b4c5d6e7f;
}

static inline float16 zip_hi(float16 a, float16 b) {
    return (float16)(a.hi, b.hi).s08192a3b4c5d6e7f;
}

/* Turns the first bit of sixteen elements' row number into the last one of their place. Four of
 * these turns make columns of rows. */
static inline void turn_matrix(const float16 from[16], float16 to[16]) {
#pragma unroll
    for (uint i = 0u; i < 8u; ++i) {
        to[2u * i] = zip_lo(from[i], from[i + 8u]);
        to[2u * i + 1u] = zip_hi(from[i], from[i + 8u]);
    }
}

/* make_trace_ray for the rays of a block, as rows but for BIT. `index`: of the first one. */
static inline void prepare_rows(global const RayBlock* block, uint index, float16 row[16]) {
    const float16 o[3] = {vload16(0, block->origin_x), vload16(0, block->origin_y),
                          vload16(0, block->origin_z)};
    const float16 d[3] = {bounded_direction16(vload16(0, block->direction_x)),
                          bounded_direction16(vload16(0, block->direction_y)),
                          bounded_direction16(vload16(0, block->direction_z))};
    const float16 margin = MACULA_RAY_MARGIN * reach16(o[0], o[1], o[2]);
    const int16 kz = dominant_axis16(d[0], d[1], d[2]);
    float16 value[16];
    for (uint axis = 0u; axis < 3u; ++axis) {
        const float16 r = m_divide((float16)(1.0f), d[axis]);
        value[MACULA_ROW_R + axis] = r;
        value[MACULA_ROW_N + axis] = fma(fabs(r), -margin, -(o[axis] * r));
    }
    const float16 sz = pick_axis16(kz, value[0], value[1], value[2]);
    value[MACULA_ROW_T_MAX] = vload16(0, block->t_max);
    value[MACULA_ROW_T_MIN] = vload16(0, block->t_min);
    value[MACULA_ROW_O] = pick_axis16(kz, o[1], o[2], o[0]);
    value[MACULA_ROW_O + 1u] = pick_axis16(kz, o[2], o[0], o[1]);
    value[MACULA_ROW_O + 2u] = pick_axis16(kz, o[0], o[1], o[2]);
    value[MACULA_ROW_S] = pick_axis16(kz, d[1], d[2], d[0]) * sz;
    value[MACULA_ROW_S + 1u] = pick_axis16(kz, d[2], d[0], d[1]) * sz;
    value[MACULA_ROW_S + 2u] = sz;
    value[MACULA_ROW_BIT] = 0.0f;
    value[MACULA_ROW_INDEX] = as_float16((int16)((int)index) + MACULA_LANES16);
    turn_matrix(value, row);
    turn_matrix(row, value);
    turn_matrix(value, row);
    turn_matrix(row, value);
    for (uint i = 0u; i < 16u; ++i)
        row[i] = value[i];
}

#endif
