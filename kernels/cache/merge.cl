/* Cache update and merge (Weier et al. 2016, section 3.4), together with the last step of the
 * reprojection: each pixel is touched once. A pixel takes its sample, blends it with its history,
 * keeps its history, or is filled from the support image. */
#include "cache/blend.h"
#include "cache/light_value.h"
#include "cache/texels.h"
#include "lib/camera.h"

/* Last frame's images. */
typedef struct Past {
    global const float4* colour;
    global const uint2* info;
    global const LightValue* light;
} Past;

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
    const float sx = place_in_support(x, frame->width, across);
    const float sy = place_in_support(y, frame->height, down);
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

/* Everything that a packet is made from. */
typedef struct Packet {
    global const FrameParams* frame;
    global const WeierParams* weier;
    uint x0, y0;
    uint sampled, fresh, inside; /* bits of lanes */
    uint first;                  /* slot of the first sample */
} Packet;

static inline uint pixel_of_lane(const Packet* p, uint lane) {
    return (p->y0 + (lane >> 2)) * p->frame->width + p->x0 + (lane & 3u);
}

/* What the samples bring. */
typedef struct Samples {
    global const float4* colour;
    global const float* depth;
    global const LightValue* light;
} Samples;

static inline void take_samples(const Packet* p, const Samples* samples, const Out* out) {
    for (uint lanes = p->sampled, slot = p->first; lanes != 0u; lanes &= lanes - 1u, ++slot)
        take_sample(out, pixel_of_lane(p, first_lane(lanes)), p->frame->frame,
                    samples->colour[slot], samples->light, slot);
}

/* The light of a row's four histories. */
MACULA_ALWAYS_INLINE void keep_lights(global const LightValue* past, const int* nearest, uint lanes,
                                      global LightValue* light) {
    const LightRow row = kept_lights(
        (LightRow)(past[nearest[0]], past[nearest[1]], past[nearest[2]], past[nearest[3]]));
    if (lanes == 15u) {
        STORE_LIGHTS(row, (global float*)light);
        return;
    }
    LightValue values[4];
    STORE_LIGHTS(row, (float*)values);
    for (uint k = 0u; k < 4u; ++k)
        if ((lanes >> k & 1u) != 0u)
            light[k] = values[k];
}

/* What a row that is kept may turn out to hold. */
typedef struct Faults {
    int16 colour; /* not 0 where it is not a number */
    int4 rho;
} Faults;

/* Histories are kept row by row; samples and gaps come afterwards. */
MACULA_ALWAYS_INLINE void keep_row(const Packet* p, const Past* past, const Lanes* t,
                                   const Spans* spans, uint row, const Out* out, InfoLanes* infos,
                                   Faults* faults) {
    const uint width = p->frame->width;
    const int16 opaque = (MACULA_LANES16 & 3) == 3;
    const float16 between = row_of_colours(past->colour, t, spans, width, row);
    const float16 colour = opaque ? (float16)(1.0f) : between;
    const int* nearest = t->nearest + 4u * row;
    const uint8 info = (uint8)(past->info[nearest[0]], past->info[nearest[1]],
                               past->info[nearest[2]], past->info[nearest[3]]);
    vstore8(info, row, infos->words);
    const float4 rho = as_float4(info.even);
    faults->colour |= !(fabs(colour) < 1e30f);
    faults->rho |= !((rho >= 0.0f) & (rho < 1e6f));
    const uint pixel = (p->y0 + row) * width + p->x0;
    const uint lanes = p->inside >> 4u * row & 15u;
    if (lanes == 15u) {
        vstore16(colour, 0, (global float*)(out->colour + pixel));
        vstore8(info, 0, (global uint*)(out->info + pixel));
    } else {
        float4 colours[4];
        uint2 infos[4];
        vstore16(colour, 0, (float*)colours);
        vstore8(info, 0, (uint*)infos);
        for (uint k = 0u; k < 4u; ++k)
            if ((lanes >> k & 1u) != 0u) {
                out->colour[pixel + k] = colours[k];
                out->info[pixel + k] = infos[k];
            }
    }
    if (out->light)
        keep_lights(past->light, nearest, lanes, out->light + pixel);
}

/* The lanes of `known` whose kept history is sound: what is not a number stays out of the cache. */
static inline uint sound_lanes(const Packet* p, uint known, const Out* out) {
    uint sound = 0u;
    for (uint lanes = known; lanes != 0u; lanes &= lanes - 1u) {
        const uint pixel = pixel_of_lane(p, first_lane(lanes));
        const float rho = as_float(out->info[pixel].x);
        if (is_number(out->colour[pixel]) && rho >= 0.0f && rho < 1e6f)
            sound |= lanes & -lanes;
    }
    return sound;
}

/* The gap is filled from the support image. */
static inline void fill(const Packet* p, global const float4* support, uint lane, const Out* out) {
    const uint pixel = pixel_of_lane(p, lane);
    const float4 colour =
        from_support(support, p->frame, p->weier, p->x0 + (lane & 3u), p->y0 + (lane >> 2));
    out->colour[pixel] = (float4)(colour.xyz, 1.0f);
    out->info[pixel] = (uint2)(as_uint(0.0f), 0u);
    if (out->light)
        out->light[pixel] = UNLIT;
}

/* Samples where history was kept in some of the lanes, `kept`. */
static inline void blend_samples(const Packet* p, const Samples* samples, uint kept,
                                 const float* inverse_depth, const InfoLanes* info,
                                 const Out* out) {
    float depth[16];
    vstore16((float16)(0.0f), 0, depth);
    for (uint lanes = p->sampled, slot = p->first; lanes != 0u; lanes &= lanes - 1u, ++slot)
        depth[first_lane(lanes)] = samples->depth[slot];
    const float16 apart = fabs(fma(vload16(0, depth), vload16(0, inverse_depth), (float16)(-1.0f)));
    const int16 blended =
        lanes_of(kept & ~p->fresh) & (apart <= (float16)(p->weier->merge_threshold));
    Blend blend;
    weigh_samples(p->weier, p->frame->frame, blended, info, &blend);
    for (uint lanes = p->sampled, slot = p->first; lanes != 0u; lanes &= lanes - 1u, ++slot) {
        const uint lane = first_lane(lanes), pixel = pixel_of_lane(p, lane);
        const float alpha = blend.alpha[lane];
        const float4 fresh = samples->colour[slot], old = out->colour[pixel];
        const float4 mixed = fma(fresh - old, (float4)(alpha), old);
        out->colour[pixel] = alpha < 1.0f ? (float4)(mixed.xyz, 1.0f) : fresh;
        out->info[pixel] = (uint2)(as_uint(blend.rho[lane]), blend.touch[lane]);
        if (out->light) {
            const LightValue lit = samples->light[slot], before = out->light[pixel];
            out->light[pixel] = alpha < 1.0f && is_lit(before)
                                    ? fma(lit - before, (LightValue)(alpha), before)
                                    : lit;
        }
    }
}

MACULA_ALWAYS_INLINE uint16 keys_of(global const uint* keys, uint pitch) {
    return (uint16)(vload4(0, keys), vload4(0, keys + pitch), vload4(0, keys + 2u * pitch),
                    vload4(0, keys + 3u * pitch));
}

/* Packets between asking for memory and using it: their addresses jump too much for a processor to
 * foresee them, and each packet waits for its keys, then for its texels. */
#define AHEAD 16u

/* Asks for what a later packet will need; `motion`: from a pixel to its history, in texels. */
MACULA_ALWAYS_INLINE void fetch_ahead(global const FrameParams* frame, uint packet, int motion,
                                      global const uint* keys, uint pitch, const Past* past,
                                      const Out* out) {
    const uint width = frame->width;
    uint x, y;
    pixel_of_slot(packet * 16u, width, &x, &y);
    for (uint row = 0u; row < 4u; ++row) {
        const long pixel = (long)(y + row) * width + x;
        MACULA_FETCH(keys, ((y + row) * pitch + x) * sizeof(uint));
        MACULA_FETCH(past->colour, (pixel + motion) * (long)sizeof(float4));
        MACULA_FETCH(past->info, (pixel + motion) * (long)sizeof(uint2));
        MACULA_FETCH_TO_WRITE(out->colour, pixel * (long)sizeof(float4));
        MACULA_FETCH_TO_WRITE(out->info, pixel * (long)sizeof(uint2));
        if (out->light) {
            MACULA_FETCH(past->light, (pixel + motion) * (long)sizeof(LightValue));
            MACULA_FETCH_TO_WRITE(out->light, pixel * (long)sizeof(LightValue));
        }
    }
}

MACULA_ALWAYS_INLINE int motion_of(const Spans* spans, const Packet* p) {
    const int pixel = (int)(p->y0 * p->frame->width + p->x0);
    return spans->first[0] != 0x7fffffff ? spans->first[0] - pixel : 0;
}

/* One work-item a packet of sixteen pixels. `reprojected_colour` may be null, and the light
 * buffers where the method has none. */
kernel void
merge_cache(global const FrameParams* restrict frame, global const WeierParams* restrict weier,
            global const float* restrict mesh_columns, global const float* restrict mesh_rows,
            global const float4* restrict vertices, global const float* restrict cells,
            global const uint* restrict keys, global const uint* restrict history_kept,
            global const uint* restrict masks, global const uint* restrict offsets,
            global const float4* restrict past_colour, global const uint2* restrict past_info,
            global const LightValue* restrict past_light,
            global const float4* restrict support_image,
            global const float4* restrict sampled_colour, global const float* restrict depth,
            global const LightValue* restrict sampled_light, global float4* restrict colour,
            global uint2* restrict info, global LightValue* restrict light,
            global float4* restrict reprojected_colour) {
    const uint packet = (uint)get_global_id(0);
    const uint width = frame->width, height = frame->height;
    Packet p;
    p.frame = frame;
    p.weier = weier;
    pixel_of_slot(packet * 16u, width, &p.x0, &p.y0);
    const uint columns = p.x0 < width ? min(width - p.x0, 4u) : 0u;
    const uint rows = p.y0 < height ? min(height - p.y0, 4u) : 0u;
    p.inside = ((1u << columns) - 1u) * (0x1111u & ((1u << 4u * rows) - 1u));
    p.sampled = masks[packet] & 0xffffu;
    p.fresh = masks[packet] >> 16;
    p.first = offsets[packet];
    const Out out = {colour, info, light};
    const Samples samples = {sampled_colour, depth, sampled_light};
    const uint rest = reprojected_colour ? p.inside : p.inside & ~p.fresh;
    if (rest == 0u) {
        take_samples(&p, &samples, &out);
        return;
    }
    const Past past = {past_colour, past_info, past_light};
    const uint16 key = keys_of(keys + p.y0 * weier->pitch + p.x0, weier->pitch);
    /* Keys with the bit are to be resampled; MACULA_NO_KEY has it, too. */
    const int16 unmarked = (key & 1u) == 0u;
    const uint known = *history_kept != 0u ? rest & bits_of_lanes16(unmarked) : 0u;
    uint kept = 0u;
    float inverse_depth[16];
    InfoLanes infos;
    if (known != 0u) {
        const float16 x = (float)p.x0 + (convert_float16(MACULA_LANES16 & 3) + 0.5f);
        const float16 y = (float)p.y0 + (convert_float16(MACULA_LANES16 >> 2) + 0.5f);
        const CellTables tables = {cells, mesh_columns, mesh_rows};
        HistoryPacket history;
        find_histories(&tables, weier, key, known, x, y, &history);
        Texels texels;
        find_texels(&history, width, height, &texels);
        Spans spans;
        find_spans(&texels, lanes_of(known), width, height, &spans);
        fetch_ahead(frame, packet + AHEAD, motion_of(&spans, &p), keys, weier->pitch, &past, &out);
        Lanes t;
        vstore16(texels.upper_left, 0, t.upper_left);
        vstore16(texels.upper_right, 0, t.upper_right);
        vstore16(texels.lower_left, 0, t.lower_left);
        vstore16(texels.lower_right, 0, t.lower_right);
        vstore16(texels.nearest, 0, t.nearest);
        vstore16(texels.to_x, 0, t.to_x);
        vstore16(texels.to_y, 0, t.to_y);
        vstore16(history.inverse_depth, 0, inverse_depth);
        vstore16((uint16)(0u), 0, infos.words);
        vstore16((uint16)(0u), 1, infos.words);
        Faults faults = {(int16)(0), (int4)(0)};
        for (uint row = 0u; row < 4u; ++row)
            if ((known >> 4u * row & 15u) != 0u)
                keep_row(&p, &past, &t, &spans, row, &out, &infos, &faults);
        faults.colour.lo.lo |= faults.rho;
        kept = any_lane16(faults.colour) ? sound_lanes(&p, known, &out) : known;
        uint key_of_lane[16];
        vstore16(key, 0, key_of_lane);
        const MeshTables mesh = {vertices, mesh_columns, mesh_rows};
        const uint wide = weier->filter_samples > 0u ? history.wide & kept : 0u;
        for (uint lanes = wide; lanes != 0u; lanes &= lanes - 1u) {
            const uint lane = first_lane(lanes);
            const float4 filtered =
                filtered_colour(past_colour, &mesh, frame, weier, key_of_lane[lane],
                                p.x0 + (lane & 3u), p.y0 + (lane >> 2));
            if (is_number(filtered))
                colour[pixel_of_lane(&p, lane)] = (float4)(filtered.xyz, 1.0f);
            else
                kept &= ~(1u << lane);
        }
    }
    if (reprojected_colour)
        for (uint lanes = rest; lanes != 0u; lanes &= lanes - 1u) {
            const uint lane = first_lane(lanes), pixel = pixel_of_lane(&p, lane);
            reprojected_colour[pixel] = (kept >> lane & 1u) != 0u ? colour[pixel] : (float4)(0.0f);
        }
    if ((kept & p.sampled & ~p.fresh) != 0u)
        blend_samples(&p, &samples, kept, inverse_depth, &infos, &out);
    else
        take_samples(&p, &samples, &out);
    for (uint lanes = p.inside & ~p.sampled & ~kept; lanes != 0u; lanes &= lanes - 1u)
        fill(&p, support_image, first_lane(lanes), &out);
}
