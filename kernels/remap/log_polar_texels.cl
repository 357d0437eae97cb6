/* What the texels around each texel of the log-polar buffer have in common. */
#include "lib/log_polar.h"
#include "shared/ray.h"
#include "shared/surface.h"

static inline float luminance(float4 c) {
    return fma(c.x, 0.2126f, fma(c.y, 0.7152f, c.z * 0.0722f));
}

/* Of three by three texels. */
typedef struct Sums {
    float least, most;                 /* depths */
    float light, squares, count;       /* of their luminance */
    float motion_x, motion_y, movable; /* of those that were in view */
} Sums;

static inline void add_texel(Sums* sums, float4 colour, float4 surface) {
    const float light = luminance(colour);
    sums->least = m_min(sums->least, surface.x);
    sums->most = m_max(sums->most, surface.x);
    sums->light = sums->light + light;
    sums->squares = fma(light, light, sums->squares);
    sums->count = sums->count + 1.0f;
    if (fabs(surface.y) < MACULA_NO_MOTION && fabs(surface.z) < MACULA_NO_MOTION) {
        sums->motion_x = sums->motion_x + surface.y;
        sums->motion_y = sums->motion_y + surface.z;
        sums->movable = sums->movable + 1.0f;
    }
}

static inline void summarise(global const LogPolarParams* params, global const Fovea* fovea,
                             global const float4* colours, global const float4* surfaces,
                             global float2* ranges, global float4* motions, uint column, uint row) {
    Sums sums = {MACULA_BACKGROUND_DEPTH, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
    for (uint k = 0u; k < 9u; ++k) {
        const uint i = column + k % 3u; /* a row begins with an empty texel */
        const uint down = row + params->height + k / 3u - 1u;
        const uint j = down >= params->height ? down - params->height : down;
        const uint at = (j >= params->height ? j - params->height : j) * params->pitch + i;
        if (i > fovea->first_column && i <= params->width && colours[at].w > 0.0f)
            add_texel(&sums, colours[at], surfaces[at]);
    }
    const float share = m_divide(1.0f, m_max(sums.count, 1.0f)), mean = sums.light * share;
    const float variance = fma(-mean, mean, sums.squares * share);
    const float spread = variance > 1e-12f ? m_sqrt(variance) : 0.0f;
    const float moved = m_divide(1.0f, m_max(sums.movable, 1.0f));
    const uint to = row * params->pitch + column + 1u;
    ranges[to] = (float2)(sums.least, sums.most);
    motions[to] = (float4)(sums.motion_x * moved, sums.motion_y * moved, spread,
                           sums.movable > 0.0f ? 1.0f : 0.0f);
}

/* One work-item MACULA_RAY_BLOCK texels of a row. ranges: the least and the greatest depth of three
 * by three texels; motions: their mean, the deviation of the luminance, 1. Texels without a sample
 * have colours whose alpha is 0. */
kernel void summarise_texels(global const LogPolarParams* restrict params,
                             global const Fovea* restrict fovea,
                             global const float4* restrict colours,
                             global const float4* restrict surfaces,
                             global float2* restrict ranges, global float4* restrict motions) {
    const uint across = (params->width + MACULA_RAY_BLOCK - 1u) / MACULA_RAY_BLOCK;
    const uint item = (uint)get_global_id(0), row = item / across;
    const uint first = item % across * MACULA_RAY_BLOCK;
    if (row >= params->height)
        return;
    const uint end = min(first + MACULA_RAY_BLOCK, params->width);
    for (uint column = max(first, fovea->first_column); column < end; ++column)
        summarise(params, fovea, colours, surfaces, ranges, motions, column, row);
}
