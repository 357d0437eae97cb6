/* The history catches up with what moves over surfaces: cache/lag.cl measures it at the support
 * samples, and each pixel takes the mean of those about it that look like it. */
#ifndef MACULA_CACHE_CATCH_UP_H
#define MACULA_CACHE_CATCH_UP_H

#include "cache/likeness.h"
#include "cache/texels.h"
#include "shared/camera.h"
#include "shared/weier.h"

/* The way from a pixel to the next, counted in support samples; constant for a frame. */
typedef struct Steps {
    float x, y;
} Steps;

static inline Steps support_steps(global const FrameParams* frame,
                                  global const WeierParams* weier) {
    Steps s;
    s.x = m_divide((float)(weier->support_width - 1u), (float)(frame->width - 1u));
    s.y = m_divide((float)(weier->support_height - 1u), (float)(frame->height - 1u));
    return s;
}

/* True where a support sample about the packet has a correction. */
static inline bool lags(global const float4* correction, uint across, uint down, float16 x,
                        float16 y) {
    const int last_column = (int)x.s3 + 1, last_row = (int)y.sc + 1;
    uint4 any = (uint4)(0u);
    for (int row = (int)y.s0; row <= last_row; ++row)
        for (int column = (int)x.s0; column <= last_column; ++column)
            any |= as_uint4(correction[texel_index(column, row, across, down)]);
    return (any.x | any.y | any.z) != 0u;
}

static inline float4 positive4(float4 v) {
    return v > 0.0f ? v : (float4)(0.0f);
}

/* Four pixels' parts of a sum over the support samples about them. */
typedef struct Behind {
    float16 sum, weight;
} Behind;

/* Adds one support sample a pixel, as far as it looks like the pixel. */
MACULA_ALWAYS_INLINE void add_lag(Behind* behind, global const float4* correction, const int* index,
                                  float16 look, float16 near) {
    const float16 lag = four_texels(correction, index);
    const float16 weight = near * likeness16(lag.s33337777bbbbffff, look);
    behind->sum = fma(lag, weight, behind->sum);
    behind->weight += weight;
}

/* Indices of the support samples about sixteen pixels. */
typedef struct Corners {
    int of[4][16];
} Corners;

/* Adds what the history lags behind to the pixels `kept` of the packet whose first one is (x0, y0).
 */
static inline void catch_up(global const WeierParams* weier, const Steps* steps,
                            global const float4* correction, uint kept, uint x0, uint y0,
                            global float4* image, uint width) {
    const uint across = weier->support_width, down = weier->support_height;
    const float16 x = ((float)x0 + convert_float16(MACULA_LANES16 & 3)) * steps->x;
    const float16 y = ((float)y0 + convert_float16(MACULA_LANES16 >> 2)) * steps->y;
    if (!lags(correction, across, down, x, y))
        return;
    const int16 i = convert_int16(x), j = convert_int16(y);
    const float16 to_x = x - convert_float16(i), to_y = y - convert_float16(j);
    const int16 i0 = min(i, (int16)((int)across - 1)), i1 = min(i + 1, (int16)((int)across - 1));
    const int16 j0 = min(j, (int16)((int)down - 1)) * (int)across;
    const int16 j1 = min(j + 1, (int16)((int)down - 1)) * (int)across;
    Corners corners;
    vstore16(j0 + i0, 0, corners.of[0]);
    vstore16(j0 + i1, 0, corners.of[1]);
    vstore16(j1 + i0, 0, corners.of[2]);
    vstore16(j1 + i1, 0, corners.of[3]);
    for (uint row = 0u; row < 4u; ++row) {
        const uint lanes = kept >> 4u * row & 15u;
        if (lanes == 0u)
            continue;
        global float4* colours = image + (y0 + row) * width + x0;
        float4 colour[4];
        for (uint k = 0u; k < 4u; ++k)
            colour[k] = (lanes >> k & 1u) != 0u ? colours[k] : (float4)(0.0f);
        const float16 past = vload16(0, (const float*)colour);
        const float16 look = m_max(past.s111155559999dddd, (float16)(0.0f)) + 0x1p-4f;
        const float16 right = spread_row(to_x, row), below = spread_row(to_y, row);
        const float16 left = 1.0f - right, above = 1.0f - below;
        Behind behind = {(float16)(0.0f), (float16)(0x1p-20f)};
        add_lag(&behind, correction, corners.of[0] + 4u * row, look, left * above);
        add_lag(&behind, correction, corners.of[1] + 4u * row, look, right * above);
        add_lag(&behind, correction, corners.of[2] + 4u * row, look, left * below);
        add_lag(&behind, correction, corners.of[3] + 4u * row, look, right * below);
        const float16 lag = m_divide(behind.sum, behind.weight);
        float4 added[4];
        vstore16(lag, 0, (float*)added);
        for (uint k = 0u; k < 4u; ++k)
            if ((lanes >> k & 1u) != 0u)
                colours[k] = (float4)(positive4(colour[k] + added[k]).xyz, colour[k].w);
    }
}

#endif
