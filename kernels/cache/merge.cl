/* Cache update and merge (Weier et al. 2016, section 3.4), together with the last step of the
 * reprojection: each pixel is touched once. A pixel takes its sample, blends it with its history,
 * keeps its history, or is filled from the support image. */
#include "lib/cache_info.h"
#include "lib/camera.h"
#include "lib/reprojection.h"

/* MACULA_LIGHT: components of the light buffer, 0 where the method has none, 1 (openness) or 4
 * (irradiance). */
#if MACULA_LIGHT == 4
typedef float4 LightValue;
static inline bool is_lit(LightValue v) {
    return v.x >= 0.0f && is_finite3(v.xyz);
}
#else
typedef float LightValue;
static inline bool is_lit(LightValue v) {
    return v >= 0.0f && v < 1e30f;
}
#endif
/* Of a pixel that has had no sample: no light is below 0. */
#define UNLIT ((LightValue)(-1.0f))

typedef struct Cache {
    float4 colour;
    LightValue light;
    float rho;  /* 0: nothing is known */
    uint touch; /* of lib/cache_info.h */
    float inverse_depth;
} Cache;

/* Last frame's images; `light` may be null. */
typedef struct Past {
    global const float4* colour;
    global const uint2* info;
    global const LightValue* light;
} Past;

/* A footprint of several texels is sampled at normally distributed places; `spread` is what it has
 * beyond one texel (section 3.2). */
static inline float4 filtered_colour(const Past* past, global const FrameParams* frame,
                                     const History* h, float spread, uint samples, uint key) {
    float4 sum = (float4)(0.0f);
    for (uint k = 0u; k < samples; ++k) {
        /* Box and Muller's pair, with the radius by way of log2: sqrt(-2 ln u). */
        const float u = 1.0f - random_unit(key, k, MACULA_DIMENSION_FOOTPRINT);
        const float angle = random_unit(key, k, MACULA_DIMENSION_FOOTPRINT + 1u);
        const float radius = spread * m_sqrt(-1.38629436f * m_log2(u));
        float cosine;
        const float sine = m_sin_cos_pi(angle + angle, &cosine);
        const float2 at =
            fma(h->per_x, (float2)(radius * cosine), fma(h->per_y, (float2)(radius * sine), h->at));
        const Footing f = footing_at(at);
        sum += bilinear4(past->colour, frame->width, frame->height, &f);
    }
    return sum * m_divide(1.0f, (float)samples);
}

static inline float squared_length(float2 v) {
    return fma(v.x, v.x, v.y * v.y);
}

/* The cache of the last frame at a pixel of this one. rho = 0 where there is none. */
static inline Cache reprojected(const Past* past, const MeshTables* mesh,
                                global const FrameParams* frame, global const WeierParams* weier,
                                uint key, uint x, uint y) {
    Cache cache;
    cache.rho = 0.0f;
    cache.touch = 0u;
    cache.colour = (float4)(0.0f);
    cache.light = UNLIT;
    cache.inverse_depth = 0.0f;
    const History h = find_history(mesh, weier, key, (float)x + 0.5f, (float)y + 0.5f);
    if (!h.found)
        return cache;
    const uint width = frame->width, height = frame->height;
    const Footing f = footing_at(h.at);
    const float footprint = m_max(squared_length(h.per_x), squared_length(h.per_y));
    /* Up to half a texel more than one, four neighbours are filter enough. */
    if (footprint > 2.25f && weier->filter_samples > 0u)
        cache.colour = filtered_colour(past, frame, &h, 0.5f, weier->filter_samples,
                                       random_key(y * width + x, frame->frame, frame->seed));
    else
        cache.colour = bilinear4(past->colour, width, height, &f);
    const uint nearest =
        texel_index(f.x + (f.to_x >= 0.5f ? 1 : 0), f.y + (f.to_y >= 0.5f ? 1 : 0), width, height);
    const uint2 info = past->info[nearest];
    const float rho = as_float(info.x);
    cache.inverse_depth = h.inverse_depth;
    cache.touch = info.y;
    /* What is not a number stays out. */
    cache.rho = rho > 0.0f && rho < 1e6f && is_finite3(cache.colour.xyz) ? rho : 0.0f;
    if (past->light)
        cache.light = is_lit(past->light[nearest]) ? past->light[nearest] : UNLIT;
    return cache;
}

/* The support image between its samples, by a quadratic B-spline over three by three of them: no
 * kinks that would show as a lattice. */
static inline float4 from_support(global const float4* image, global const FrameParams* frame,
                                  global const WeierParams* weier, uint x, uint y) {
    const uint across = weier->support_width, down = weier->support_height;
    const float sx = ((float)x + 0.5f) * m_divide((float)across, (float)frame->width);
    const float sy = ((float)y + 0.5f) * m_divide((float)down, (float)frame->height);
    const int i = (int)rint(floor(sx)), j = (int)rint(floor(sy));
    const float tx = sx - (float)i, ty = sy - (float)j;
    const float rx = 1.0f - tx, ry = 1.0f - ty;
    const float wx[3] = {0.5f * rx * rx, fma(tx, rx, 0.5f), 0.5f * tx * tx};
    const float wy[3] = {0.5f * ry * ry, fma(ty, ry, 0.5f), 0.5f * ty * ty};
    float4 sum = (float4)(0.0f);
    for (int row = 0; row < 3; ++row) {
        float4 line = (float4)(0.0f);
        for (int column = 0; column < 3; ++column)
            line = fma((float4)(wx[column]),
                       image[texel_index(i + column - 1, j + row - 1, across, down)], line);
        sum = fma((float4)(wy[row]), line, sum);
    }
    return (float4)(sum.xyz, 1.0f);
}

/* The new sample and the cache have the same surface. */
static inline bool same_surface(float depth, float inverse_depth, float threshold) {
    const float ratio = depth * inverse_depth;
    return fabs(ratio - 1.0f) <= threshold;
}

/* One work-item a packet of sixteen pixels. `reprojected_colour` may be null, and the light
 * buffers where the method has none. */
kernel void merge_cache(
    global const FrameParams* restrict frame, global const WeierParams* restrict weier,
    global const float* restrict mesh_columns, global const float* restrict mesh_rows,
    global const float4* restrict vertices, global const uint* restrict keys,
    global const uint* restrict history, global const uint* restrict masks,
    global const float4* restrict past_colour, global const uint2* restrict past_info,
    global const LightValue* restrict past_light, global const float4* restrict support_image,
    global const float4* restrict sampled_colour, global const float* restrict sampled_depth,
    global const LightValue* restrict sampled_light, global float4* restrict colour,
    global uint2* restrict info, global LightValue* restrict light,
    global float4* restrict reprojected_colour) {
    const uint packet = (uint)get_global_id(0);
    const uint width = frame->width, height = frame->height, now = frame->frame;
    const uint mask = masks[packet];
    const Past past = {past_colour, past_info, past_light};
    const MeshTables mesh = {vertices, mesh_columns, mesh_rows};
    const bool has_history = *history != 0u;
    uint x0, y0;
    pixel_of_slot(packet * 16u, width, &x0, &y0);
    for (uint lane = 0u; lane < 16u; ++lane) {
        const uint x = x0 + (lane & 3u), y = y0 + (lane >> 2);
        if (x >= width || y >= height)
            continue;
        const uint pixel = y * width + x;
        const bool sampled = (mask >> lane & 1u) != 0u, fresh = (mask >> (lane + 16u) & 1u) != 0u;
        Cache cache;
        cache.rho = 0.0f;
        cache.light = UNLIT;
        const uint key = has_history ? keys[y * weier->pitch + x] : MACULA_NO_KEY;
        const bool known = key != MACULA_NO_KEY && (key & 1u) == 0u;
        if (known && (!fresh || reprojected_colour))
            cache = reprojected(&past, &mesh, frame, weier, key, x, y);
        if (reprojected_colour)
            reprojected_colour[pixel] = cache.rho > 0.0f ? cache.colour : (float4)(0.0f);
        if (sampled) {
            const float4 sample = sampled_colour[pixel];
            const bool blended =
                !fresh && cache.rho > 0.0f &&
                same_surface(sampled_depth[pixel], cache.inverse_depth, weier->merge_threshold);
            const float alpha =
                blended
                    ? blending_weight(cache.rho, least_weight(age_of_touch(cache.touch, now),
                                                              weier->log2_k_min,
                                                              weier->log2_k_slope, weier->k_max))
                    : 1.0f;
            colour[pixel] =
                blended
                    ? (float4)(fma(sample - cache.colour, (float4)(alpha), cache.colour).xyz, 1.0f)
                    : sample;
            info[pixel] = (uint2)(as_uint(blended ? samples_worth(alpha, cache.rho) : 1.0f),
                                  pack_touch(alpha, now));
            if (light) {
                const LightValue lit = sampled_light[pixel];
                light[pixel] = blended && is_lit(cache.light)
                                   ? fma(lit - cache.light, (LightValue)(alpha), cache.light)
                                   : lit;
            }
        } else {
            const bool kept = cache.rho > 0.0f;
            colour[pixel] = kept ? (float4)(cache.colour.xyz, 1.0f)
                                 : from_support(support_image, frame, weier, x, y);
            info[pixel] = kept ? (uint2)(as_uint(cache.rho), cache.touch) : (uint2)(0u);
            if (light)
                light[pixel] = kept ? cache.light : UNLIT;
        }
    }
}
