/* Cache update and merge (Weier et al. 2016, section 3.4), together with the last step of the
 * reprojection: each pixel is touched once. A pixel takes its sample, blends it with its history,
 * keeps its history, or is filled from the support image. */
#include "cache/light_value.h"
#include "lib/cache_info.h"
#include "lib/camera.h"
#include "lib/reprojection_packet.h"

/* Last frame's images. */
typedef struct Past {
    global const float4* colour;
    global const uint2* info;
    global const LightValue* light;
} Past;

/* What the cache has for a pixel. */
typedef struct Cache {
    float4 colour;
    LightValue light;
    float rho;  /* 0: the colour is a guess */
    uint touch; /* of lib/cache_info.h */
} Cache;

/* The four texels around a place, as indices, and how far it is from the first one. */
typedef struct Texels {
    uint index[4][16];
    float to_x[16], to_y[16];
    uint nearest[16];
} Texels;

/* Places are counted in 1/256 of a pixel, as texture units do: a place within 1/512 of a texel's
 * middle is that texel exactly, so that nothing drifts while the view stands still. */
static inline void find_texels(const HistoryPacket* history, uint width, uint height, Texels* t) {
    const int16 x = convert_int16(rint(fma(history->x, (float16)(256.0f), (float16)(-128.0f))));
    const int16 y = convert_int16(rint(fma(history->y, (float16)(256.0f), (float16)(-128.0f))));
    const int16 right = (int16)((int)width - 1), bottom = (int16)((int)height - 1);
    const int16 x0 = clamp(x >> 8, (int16)(0), right), x1 = clamp((x >> 8) + 1, (int16)(0), right);
    const int16 y0 = clamp(y >> 8, (int16)(0), bottom) * (int)width;
    const int16 y1 = clamp((y >> 8) + 1, (int16)(0), bottom) * (int)width;
    vstore16(as_uint16(y0 + x0), 0, t->index[0]);
    vstore16(as_uint16(y0 + x1), 0, t->index[1]);
    vstore16(as_uint16(y1 + x0), 0, t->index[2]);
    vstore16(as_uint16(y1 + x1), 0, t->index[3]);
    vstore16(convert_float16(x & 255) * 0x1p-8f, 0, t->to_x);
    vstore16(convert_float16(y & 255) * 0x1p-8f, 0, t->to_y);
    const int16 near_x = (x & 255) >= 128 ? x1 : x0, near_y = (y & 255) >= 128 ? y1 : y0;
    vstore16(as_uint16(near_y + near_x), 0, t->nearest);
}

static inline float4 bilinear(global const float4* image, const Texels* t, uint lane) {
    const float4 a = image[t->index[0][lane]], b = image[t->index[1][lane]];
    const float4 c = image[t->index[2][lane]], d = image[t->index[3][lane]];
    const float4 top = fma(b - a, (float4)(t->to_x[lane]), a);
    const float4 bottom = fma(d - c, (float4)(t->to_x[lane]), c);
    return fma(bottom - top, (float4)(t->to_y[lane]), top);
}

/* A footprint of several texels is sampled at normally distributed places (section 3.2). */
static inline float4 filtered_colour(global const float4* image, const MeshTables* mesh,
                                     global const FrameParams* frame,
                                     global const WeierParams* weier, uint key, uint x, uint y) {
    const History h = find_history(mesh, weier, key, (float)x + 0.5f, (float)y + 0.5f);
    const uint random = random_key(y * frame->width + x, frame->frame, frame->seed);
    float4 sum = (float4)(0.0f);
    for (uint k = 0u; k < weier->filter_samples; ++k) {
        /* Box and Muller's pair, the radius by way of log2: sqrt(-2 ln u) times half a pixel. */
        const float u = 1.0f - random_unit(random, k, MACULA_DIMENSION_FOOTPRINT);
        const float turn = random_unit(random, k, MACULA_DIMENSION_FOOTPRINT + 1u);
        const float radius = 0.5f * m_sqrt(m_max(-1.38629436f * m_log2(u), 0.0f));
        float cosine;
        const float sine = m_sin_cos_pi(turn + turn, &cosine);
        const float2 at =
            fma(h.per_x, (float2)(radius * cosine), fma(h.per_y, (float2)(radius * sine), h.at));
        const float2 kept =
            clamp(at, (float2)(0.0f), (float2)((float)frame->width, (float)frame->height));
        const Footing f = footing_at(kept);
        sum += bilinear4(image, frame->width, frame->height, &f);
    }
    return sum * m_divide(1.0f, (float)weier->filter_samples);
}

static inline bool is_number(float4 colour) {
    const int4 finite = fabs(colour) < 1e30f;
    return (finite.x & finite.y & finite.z) != 0;
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
    return sum;
}

/* A pixel's new state. */
typedef struct Out {
    global float4* colour;
    global uint2* info;
    global LightValue* light;
} Out;

static inline void take_sample(const Out* out, uint pixel, uint now, float4 colour,
                               global const LightValue* light, uint slot) {
    out->colour[pixel] = colour;
    out->info[pixel] = (uint2)(as_uint(1.0f), pack_touch(1.0f, now));
    if (out->light)
        out->light[pixel] = light[slot];
}

/* Equation 1. */
static inline void blend_sample(const Out* out, uint pixel, uint now,
                                global const WeierParams* weier, float4 colour,
                                global const LightValue* light, uint slot, const Cache* cache) {
    const float k = least_weight(age_of_touch(cache->touch, now), weier->log2_k_min,
                                 weier->log2_k_slope, weier->k_max);
    const float alpha = blending_weight(cache->rho, k);
    const float4 blended = fma(colour - cache->colour, (float4)(alpha), cache->colour);
    out->colour[pixel] = alpha < 1.0f ? (float4)(blended.xyz, 1.0f) : colour;
    out->info[pixel] = (uint2)(as_uint(samples_worth(alpha, cache->rho)), pack_touch(alpha, now));
    if (out->light) {
        const LightValue lit = light[slot];
        out->light[pixel] = alpha < 1.0f && is_lit(cache->light)
                                ? fma(lit - cache->light, (LightValue)(alpha), cache->light)
                                : lit;
    }
}

static inline uint known_lanes(const uint* keys) {
    uint known = 0u;
    for (uint lane = 0u; lane < 16u; ++lane)
        known |= (keys[lane] & 1u) == 0u ? 1u << lane : 0u; /* MACULA_NO_KEY is odd, too */
    return known;
}

/* One work-item a packet of sixteen pixels. `reprojected_colour` may be null, and the light
 * buffers where the method has none. */
kernel void
merge_cache(global const FrameParams* restrict frame, global const WeierParams* restrict weier,
            global const float* restrict mesh_columns, global const float* restrict mesh_rows,
            global const float4* restrict vertices, global const uint* restrict keys,
            global const uint* restrict history_kept, global const uint* restrict masks,
            global const uint* restrict offsets, global const float4* restrict past_colour,
            global const uint2* restrict past_info, global const LightValue* restrict past_light,
            global const float4* restrict support_image,
            global const float4* restrict sampled_colour, global const float* restrict depth,
            global const LightValue* restrict sampled_light, global float4* restrict colour,
            global uint2* restrict info, global LightValue* restrict light,
            global float4* restrict reprojected_colour) {
    const uint packet = (uint)get_global_id(0);
    const uint width = frame->width, height = frame->height, now = frame->frame;
    const uint sampled = masks[packet] & 0xffffu, fresh = masks[packet] >> 16;
    const uint first = offsets[packet]; /* slot of the packet's first sample */
    const Out out = {colour, info, light};
    uint x0, y0;
    pixel_of_slot(packet * 16u, width, &x0, &y0);
    const uint columns = x0 < width ? min(width - x0, 4u) : 0u;
    const uint rows = y0 < height ? min(height - y0, 4u) : 0u;
    const uint inside = ((1u << columns) - 1u) * (0x1111u & ((1u << 4u * rows) - 1u));
    for (uint lanes = fresh; lanes != 0u; lanes &= lanes - 1u) {
        const uint lane = first_lane(lanes);
        const uint pixel = (y0 + (lane >> 2)) * width + x0 + (lane & 3u);
        const uint slot = first + popcount(sampled & ((1u << lane) - 1u));
        take_sample(&out, pixel, now, sampled_colour[slot], sampled_light, slot);
    }
    const uint rest = reprojected_colour ? inside : inside & ~fresh;
    if (rest == 0u)
        return;

    uint key[16];
    for (uint row = 0u; row < 4u; ++row)
        vstore4(vload4(0, keys + (y0 + row) * weier->pitch + x0), row, key);
    const uint known = *history_kept != 0u ? rest & known_lanes(key) : 0u;
    const float16 x = (float)x0 + (float16)(0.5f, 1.5f, 2.5f, 3.5f, 0.5f, 1.5f, 2.5f, 3.5f, 0.5f,
                                            1.5f, 2.5f, 3.5f, 0.5f, 1.5f, 2.5f, 3.5f);
    const float16 y = (float)y0 + (float16)(0.5f, 0.5f, 0.5f, 0.5f, 1.5f, 1.5f, 1.5f, 1.5f, 2.5f,
                                            2.5f, 2.5f, 2.5f, 3.5f, 3.5f, 3.5f, 3.5f);
    const MeshTables mesh = {vertices, mesh_columns, mesh_rows};
    HistoryPacket history;
    find_histories(&mesh, weier, key, known, x, y, &history);
    Texels texels;
    find_texels(&history, width, height, &texels);
    float inverse_depth[16];
    vstore16(history.inverse_depth, 0, inverse_depth);
    const uint wide = weier->filter_samples > 0u ? history.wide : 0u;

    for (uint lanes = known; lanes != 0u; lanes &= lanes - 1u) {
        const uint lane = first_lane(lanes);
        MACULA_FETCH(past_colour, (ulong)texels.index[0][lane] * sizeof(float4));
        MACULA_FETCH(past_colour, (ulong)texels.index[2][lane] * sizeof(float4));
        MACULA_FETCH(past_info, (ulong)texels.nearest[lane] * sizeof(uint2));
    }

    for (uint lanes = rest; lanes != 0u; lanes &= lanes - 1u) {
        const uint lane = first_lane(lanes), bit = lanes & -lanes;
        const uint px = x0 + (lane & 3u), py = y0 + (lane >> 2), pixel = py * width + px;
        Cache cache;
        cache.colour = (float4)(0.0f);
        cache.light = UNLIT;
        cache.rho = 0.0f;
        cache.touch = 0u;
        bool found = (known & bit) != 0u;
        if (found) {
            cache.colour = (wide & bit) != 0u ? filtered_colour(past_colour, &mesh, frame, weier,
                                                                key[lane], px, py)
                                              : bilinear(past_colour, &texels, lane);
            const uint2 word = past_info[texels.nearest[lane]];
            const float rho = as_float(word.x);
            /* What is not a number stays out of the cache. */
            found = is_number(cache.colour) && rho >= 0.0f && rho < 1e6f;
            cache.rho = found ? rho : 0.0f;
            cache.touch = word.y;
            if (light && found)
                cache.light = kept_light(past_light[texels.nearest[lane]]);
        }
        if (reprojected_colour)
            reprojected_colour[pixel] = found ? (float4)(cache.colour.xyz, 1.0f) : (float4)(0.0f);
        if ((fresh & bit) != 0u)
            continue;
        if ((sampled & bit) != 0u) {
            const uint slot = first + popcount(sampled & (bit - 1u));
            const float same = fabs(fma(depth[slot], inverse_depth[lane], -1.0f));
            if (found && same <= weier->merge_threshold)
                blend_sample(&out, pixel, now, weier, sampled_colour[slot], sampled_light, slot,
                             &cache);
            else
                take_sample(&out, pixel, now, sampled_colour[slot], sampled_light, slot);
        } else {
            const float4 shown =
                found ? cache.colour : from_support(support_image, frame, weier, px, py);
            colour[pixel] = (float4)(shown.xyz, 1.0f);
            info[pixel] = (uint2)(as_uint(cache.rho), cache.touch);
            if (light)
                light[pixel] = cache.light;
        }
    }
}
