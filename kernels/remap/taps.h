/* Weighted sums over a few neighbouring texels, MACULA_TAPS along each axis (2 or 3), of a
 * buffer of four floats a texel. OpenCL C only. */
#ifndef MACULA_REMAP_TAPS_H
#define MACULA_REMAP_TAPS_H

#include "lib/lane_array.h"
#include "lib/log_polar.h"
#include "lib/strip.h"
#include "remap/weights.h"

/* What the lanes read: for each row its weight and how many bytes its first texel lies behind the
 * buffer's, and the weights of the texels side by side from there on. */
typedef struct Taps {
    Real columns[MACULA_TAPS];
    float rows[MACULA_TAPS][MACULA_LANES];
    uint first[MACULA_TAPS][MACULA_LANES];
} Taps;

/* `texel`: its index. */
MACULA_ALWAYS_INLINE void put_row(Taps* taps, int row, Uint texel, Real weight) {
    put_uint_lanes(taps->first[row], texel << 4);
    put_lanes(taps->rows[row], weight);
}

MACULA_ALWAYS_INLINE global const float4* first_texel(global const float4* texels, const Taps* taps,
                                               int row, uint lane) {
    return (global const float4*)((global const char*)texels + taps->first[row][lane]);
}

#if MACULA_LANES == 1

MACULA_ALWAYS_INLINE Lane4 read_taps(global const float4* texels, const Taps* taps) {
    float4 sum = (float4)(0.0f);
    for (int i = 0; i < MACULA_TAPS; ++i) {
        float4 column = taps->rows[0][0] * first_texel(texels, taps, 0, 0u)[i];
        for (int j = 1; j < MACULA_TAPS; ++j)
            column = fma((float4)(taps->rows[j][0]), first_texel(texels, taps, j, 0u)[i], column);
        sum = i == 0 ? taps->columns[0] * column : fma((float4)(taps->columns[i]), column, sum);
    }
    const Lane4 v = {sum.xyz, sum.w};
    return v;
}

#else

MACULA_ALWAYS_INLINE float16 four_texels(global const float4* first) {
    return vload16(0, (global const float*)first);
}

/* Of four texels side by side, of which the taps may be fewer: sums along their columns. */
MACULA_ALWAYS_INLINE float16 column_sums(global const float4* texels, const Taps* taps,
                                         uint lane) {
    float16 sum = taps->rows[0][lane] * four_texels(first_texel(texels, taps, 0, lane));
    for (int j = 1; j < MACULA_TAPS; ++j)
        sum = fma((float16)(taps->rows[j][lane]),
                  four_texels(first_texel(texels, taps, j, lane)), sum);
    return sum;
}

/* Of four lanes from `lane` on; `weights`: of their columns, each four times. */
MACULA_ALWAYS_INLINE float16 sums_of_four(global const float4* texels, const Taps* taps, uint lane,
                                   const float16 weights[MACULA_TAPS]) {
    const float16 a = column_sums(texels, taps, lane), b = column_sums(texels, taps, lane + 1u);
    const float16 c = column_sums(texels, taps, lane + 2u);
    const float16 d = column_sums(texels, taps, lane + 3u);
    float16 sum = weights[0] * (float16)(a.s0123, b.s0123, c.s0123, d.s0123);
    sum = fma(weights[1], (float16)(a.s4567, b.s4567, c.s4567, d.s4567), sum);
#if MACULA_TAPS > 2
    sum = fma(weights[2], (float16)(a.s89ab, b.s89ab, c.s89ab, d.s89ab), sum);
#endif
    return sum;
}

MACULA_ALWAYS_INLINE Lane4 read_taps(global const float4* texels, const Taps* taps) {
    float16 w[4][MACULA_TAPS];
    for (int i = 0; i < MACULA_TAPS; ++i) {
        w[0][i] = taps->columns[i].s0000111122223333;
        w[1][i] = taps->columns[i].s4444555566667777;
        w[2][i] = taps->columns[i].s88889999aaaabbbb;
        w[3][i] = taps->columns[i].sccccddddeeeeffff;
    }
    return lane4_of(sums_of_four(texels, taps, 0u, w[0]), sums_of_four(texels, taps, 4u, w[1]),
                    sums_of_four(texels, taps, 8u, w[2]), sums_of_four(texels, taps, 12u, w[3]));
}

#endif
/* What `wanted` pixels show: sums of colours times their weights, of which those without a sample
 * have none. Towards the disk's middle that passes into the samples that the image holds. `near`:
 * how near a sample lies, which alpha tells. */
MACULA_ALWAYS_INLINE void store_remapped(global const Fovea* fovea, const Strip* s, Real distance,
                                  Mask wanted, Lane4 sum, Real near, global float4* image) {
    const Real one = splat(1.0f);
    const Real scale = m_divide(one, m_max(sum.w, splat(LEAST_SUM)));
    Real3 colour = scale3(sum.xyz, scale);
    if (any_lane(distance < splat(fovea->radius))) {
        const Real3 sampled = colours_at(image, s, 0, 0).xyz;
        const Real disk = part_of_disk(fovea, distance);
        const Real3 mixed = scale_add3(sub3(sampled, colour), disk, colour);
        colour = select3(disk > splat(0.0f), mixed, colour);
        colour = select3(wanted, colour, sampled);
        near = wanted ? fma(one - near, disk, near) : one;
    }
    store_weighed(image, s, colour, near);
}

#endif
