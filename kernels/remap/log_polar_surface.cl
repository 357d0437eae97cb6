/* What the pixels of log-polar and log-rectilinear foveation show, for what gathers samples over
 * frames: where it was and how far away. Beyond the disk a sample stands for many pixels, and the
 * next frame's for others there: motion is the mean over the samples around a pixel, depth their
 * range. */
#include "shared/ray.h"
#include "upscale/follow.h"
#include "upscale/fovea.h"

/* Where a strip's pixels lie in the buffer: in texels, 0 being the middle of the first one. */
typedef struct Place {
    Real column, row;
} Place;

/* 1 for the log-rectilinear buffer. */
#if MACULA_RECTANGULAR
#include "remap/places_rect.h"
#else
#include "remap/places_polar.h"
#endif

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
        const uint at = row_of_texels(params, (int)(row + k / 3u) - 1) * params->pitch + i;
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

/* Between two by two texels; those without motion count nothing, and none at all: no motion. */
static inline Lane4 motion_at(global const LogPolarParams* params, global const float4* motions,
                              const Place* p) {
    const Real left = floor(p->column), top = floor(p->row);
    const Real to_x = p->column - left, to_y = p->row - top;
    const Int column = to_int(left), row = to_int(top);
    const Int right = min(column + 1, splat_int((int)params->width - 1));
    const Real one = splat(1.0f);
    const Real weights[4] = {(one - to_x) * (one - to_y), to_x * (one - to_y), (one - to_x) * to_y,
                             to_x * to_y};
    Lane4 sum = {splat_vector(splat3(0.0f)), splat(0.0f)};
    for (int k = 0; k < 4; ++k) {
        const Lane4 texel =
            gather4(motions, texel_at(params, (k & 1) == 0 ? column : right, row + (k >> 1)));
        const Real weight = weights[k] * texel.w;
        sum.xyz = scale_add3(texel.xyz, weight, sum.xyz);
        sum.w = sum.w + weight;
    }
    const Mask known = sum.w > splat(1e-3f);
    const Real share = m_divide(one, known ? sum.w : one), none = splat(MACULA_NO_MOTION);
    sum.xyz.x = known ? sum.xyz.x * share : none;
    sum.xyz.y = known ? sum.xyz.y * share : none;
    sum.xyz.z = sum.xyz.z * share;
    return sum;
}

/* One work-item a strip. sampled: depth and motion of the disk. range, followed: as of
 * follow_surfaces(); spread: the deviation of the samples that a pixel is made of; 0: the disk. */
kernel void remap_surfaces(global const FrameParams* restrict frame,
                           global const LogPolarParams* restrict params,
                           global const Fovea* restrict fovea, global const float2* restrict ranges,
                           global const float4* restrict motions,
                           global const float* restrict sampled,
                           global const float* restrict past_range, global float* restrict range,
                           global float* restrict followed, global float* restrict spread) {
    const Strip s = strip_of_item(frame->width, frame->height);
    if (s.y >= s.height)
        return;
    const uint pixels = frame->width * frame->height;
    const Real distance = distance_to_gaze(fovea, &s), zero = splat(0.0f);
    Real motion_x = zero, motion_y = zero, deviation = zero;
    Depths depths = {zero, zero}, kept = {zero, zero};
    const Mask beyond = distance >= splat(fovea->radius);
    if (any_lane(strip_inside(&s) & beyond)) {
        const Real x = strip_middles(&s) - splat(fovea->x);
        const Real y = splat(((float)s.y + 0.5f) - fovea->y);
        const Place p =
            place_in_buffer(frame, params, fovea, x, y, m_max(distance, splat(fovea->inner)));
        const Uint nearest = texel_at(params, to_int(rint(p.column)), to_int(rint(p.row)));
        const Lane4 motion = motion_at(params, motions, &p);
        depths.least = MACULA_GATHER(float, ranges, nearest, .x);
        depths.most = MACULA_GATHER(float, ranges, nearest, .y);
        kept = depths;
        motion_x = motion.xyz.x;
        motion_y = motion.xyz.y;
        deviation = motion.xyz.z;
    }
    if (any_lane(strip_inside(&s) & (distance < splat(fovea->radius)))) {
        /* At its edge a pixel has neighbours that were not sampled. */
        const Mask within = distance < splat(fovea->radius - 1.5f);
        const Nearest around = nearest_surface(sampled, pixels, &s);
        const Real own = plane_at(sampled + MACULA_PLANE_DEPTH * pixels, &s, 0, 0);
        const Real own_x = plane_at(sampled + MACULA_PLANE_MOTION_X * pixels, &s, 0, 0);
        const Real own_y = plane_at(sampled + MACULA_PLANE_MOTION_Y * pixels, &s, 0, 0);
        const Real nearest = within ? around.depth : own;
        depths.least = beyond ? depths.least : nearest;
        depths.most = beyond ? depths.most : nearest;
        kept.least = beyond ? kept.least : nearest;
        const Real behind = within ? seam_depth(&around, own, own_x, own_y) : own;
        kept.most = beyond ? kept.most : behind;
        motion_x = beyond ? motion_x : (within ? around.motion_x : own_x);
        motion_y = beyond ? motion_y : (within ? around.motion_y : own_y);
        deviation = beyond ? deviation : zero;
    }
    store_plane(range, &s, kept.least);
    store_plane(range + pixels, &s, kept.most);
    store_plane(spread, &s, deviation);
    store_followed(frame, &s, motion_x, motion_y, depths, past_range, followed);
}
