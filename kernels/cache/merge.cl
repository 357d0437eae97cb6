/* Cache update and merge (Weier et al. 2016, section 3.4), together with the last step of the
 * reprojection: each pixel is touched once. A pixel takes its sample, blends it with its history,
 * keeps its history, or is filled from the support image. */
#include "cache/catch_up.h"
#include "cache/samples.h"
#include "cache/texels.h"
#include "lib/camera.h"

/* Last frame's images. */
typedef struct Past {
    global const float4* colour;
    global const uint2* info;
    global const LightValue* light;
} Past;

/* The cells as packets read them, and as single pixels do. */
typedef struct Mesh {
    CellTables cells;
    MeshTables tables;
} Mesh;

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

/* Sixteen samples that all take their pixels' places. */
static inline void take_packet(const Packet* p, const Samples* samples, const Out* out) {
    const uint2 once = (uint2)(as_uint(1.0f), pack_touch(1.0f, p->frame->frame));
    const uint8 info = (uint8)(once, once, once, once);
    for (uint row = 0u; row < 4u; ++row) {
        const uint pixel = pixel_of_lane(p, 4u * row), slot = p->first + 4u * row;
        vstore16(vload16(0, (global const float*)(samples->colour + slot)), 0,
                 (global float*)(out->colour + pixel));
        vstore8(info, 0, (global uint*)(out->info + pixel));
        for (uint k = 0u; out->light && k < 4u; ++k)
            out->light[pixel + k] = samples->light[slot + k];
    }
}

/* The packet's samples, where history was kept in the lanes `kept`. */
MACULA_ALWAYS_INLINE void collect_samples(const Packet* p, uint kept, float16 inverse_depth,
                                          Waiting* waiting) {
    float depth[16];
    vstore16(lanes_of(kept & ~p->fresh) ? inverse_depth : (float16)(NO_HISTORY), 0, depth);
    for (uint lanes = p->sampled, slot = p->first; lanes != 0u; lanes &= lanes - 1u, ++slot) {
        const uint lane = first_lane(lanes);
        let_wait(waiting, pixel_of_lane(p, lane), slot, depth[lane]);
    }
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

/* What lies between texels is blurred by being read, and worth the less (rho). Less than 2^-20 is
 * nothing, so that no device meets a denormal. */
MACULA_ALWAYS_INLINE float4 worth_when_read(const Packet* p, const Sources* sources, uint row,
                                            float4 rho) {
    const int4 between = vload4(row, sources->lanes.between);
    const float4 less = rho * p->weier->resampled_worth;
    return between ? (less < 0x1p-20f ? (float4)(0.0f) : less) : rho;
}

/* Histories are kept row by row; samples and gaps come afterwards. */
MACULA_ALWAYS_INLINE void keep_row(const Packet* p, const Past* past, const Sources* sources,
                                   uint row, const Out* out, Faults* faults) {
    const uint width = p->frame->width;
    const int16 opaque = (MACULA_LANES16 & 3) == 3;
    const float16 between = row_of_colours(past->colour, sources, width, row);
    const float16 colour = opaque ? (float16)(1.0f) : between;
    const int* nearest = sources->lanes.nearest + 4u * row;
    uint8 info = (uint8)(past->info[nearest[0]], past->info[nearest[1]], past->info[nearest[2]],
                         past->info[nearest[3]]);
    const float4 rho = as_float4(info.even);
    faults->colour |= !(fabs(colour) < 1e30f);
    faults->rho |= !((rho >= 0.0f) & (rho < 1e6f));
    info.even = as_uint4(worth_when_read(p, sources, row, rho));
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

MACULA_ALWAYS_INLINE uint16 keys_of(global const uint* keys, uint pitch) {
    return (uint16)(vload4(0, keys), vload4(0, keys + pitch), vload4(0, keys + 2u * pitch),
                    vload4(0, keys + 3u * pitch));
}

/* Pixels between asking for memory and using it: each row of a packet begins in another page, and
 * few processors follow that many streams by themselves. */
#define AHEAD 64u

/* Asks for what a later packet will need; `motion`: from a pixel to its history, in texels. The
 * rows above are there already, from the packets above and from this one's. */
MACULA_ALWAYS_INLINE void fetch_ahead(const Packet* p, int motion, global const uint* keys,
                                      const Past* past, const Out* out) {
    const uint width = p->frame->width, pitch = p->weier->pitch;
    for (uint row = 0u; row < 4u; ++row) {
        const long pixel = (long)((p->y0 + row) * width + p->x0 + AHEAD);
        MACULA_FETCH(keys, ((p->y0 + row) * pitch + p->x0 + AHEAD) * sizeof(uint));
        MACULA_FETCH(past->colour, (pixel + motion + 2 * (long)width) * (long)sizeof(float4));
        MACULA_FETCH(past->info, (pixel + motion) * (long)sizeof(uint2));
        MACULA_FETCH_TO_WRITE(out->colour, pixel * (long)sizeof(float4));
        MACULA_FETCH_TO_WRITE(out->info, pixel * (long)sizeof(uint2));
        if (out->light) {
            MACULA_FETCH(past->light, (pixel + motion) * (long)sizeof(LightValue));
            MACULA_FETCH_TO_WRITE(out->light, pixel * (long)sizeof(LightValue));
        }
    }
}

/* The kept histories of the lanes `known`. Returns those that are sound; `inverse_depth`: of all.
 */
MACULA_ALWAYS_INLINE uint keep_histories(const Packet* p, const Mesh* mesh, const Past* past,
                                         uint16 key, uint known, const Out* out,
                                         float16* inverse_depth, int* motion) {
    const float16 x = (float)p->x0 + (convert_float16(MACULA_LANES16 & 3) + 0.5f);
    const float16 y = (float)p->y0 + (convert_float16(MACULA_LANES16 >> 2) + 0.5f);
    HistoryPacket history;
    find_histories(&mesh->cells, p->weier, key, known, x, y, &history);
    *inverse_depth = history.inverse_depth;
    Sources sources;
    find_sources(&history, lanes_of(known), p->frame->width, p->frame->height, &sources);
    if (sources.spans.first[0] != 0x7fffffff)
        *motion = sources.spans.first[0] - (int)(p->y0 * p->frame->width + p->x0);
    Faults faults = {(int16)(0), (int4)(0)};
    for (uint row = 0u; row < 4u; ++row)
        if ((known >> 4u * row & 15u) != 0u)
            keep_row(p, past, &sources, row, out, &faults);
    faults.colour.lo.lo |= faults.rho;
    uint kept = any_lane16(faults.colour) ? sound_lanes(p, known, out) : known;
    const uint wide = p->weier->filter_samples > 0u ? history.wide & kept : 0u;
    if (wide == 0u)
        return kept;
    uint key_of_lane[16];
    vstore16(key, 0, key_of_lane);
    for (uint lanes = wide; lanes != 0u; lanes &= lanes - 1u) {
        const uint lane = first_lane(lanes);
        const float4 filtered =
            filtered_colour(past->colour, &mesh->tables, p->frame, p->weier, key_of_lane[lane],
                            p->x0 + (lane & 3u), p->y0 + (lane >> 2));
        if (is_number(filtered))
            out->colour[pixel_of_lane(p, lane)] = (float4)(filtered.xyz, 1.0f);
        else
            kept &= ~(1u << lane);
    }
    return kept;
}

/* Lanes of the packet whose nearest support sample hit another surface than its history is of. */
MACULA_ALWAYS_INLINE uint contradicted_lanes(global const WeierParams* weier, const Steps* steps,
                                             global const uint* change, uint x0, uint y0) {
    const uint across = weier->support_width, down = weier->support_height;
    uint bits = 0u;
    for (uint lane = 0u; lane < 16u; ++lane) {
        const int i = (int)fma((float)(x0 + (lane & 3u)), steps->x, 0.5f);
        const int j = (int)fma((float)(y0 + (lane >> 2)), steps->y, 0.5f);
        const uint found = change[texel_index(i, j, across, down)];
        bits |= (found & MACULA_CHANGE_OF_SURFACE) != 0u ? 1u << lane : 0u;
    }
    return bits;
}

/* One work-item MACULA_PACKETS packets of sixteen pixels, side by side: what they read lies in a
 * few rows. `reprojected_colour` and `correction` may be null, `change` where nothing moved, and
 * the light buffers where the method has none. */
kernel void
merge_cache(global const FrameParams* restrict frame, global const WeierParams* restrict weier,
            global const float* restrict mesh_columns, global const float* restrict mesh_rows,
            global const float4* restrict vertices, global const float* restrict cells,
            global const uint* restrict keys, global const uint* restrict history_kept,
            global const uint* restrict masks, global const uint* restrict offsets,
            global const float4* restrict past_colour, global const uint2* restrict past_info,
            global const LightValue* restrict past_light,
            global const float4* restrict support_image, global const float4* restrict correction,
            global const uint* restrict change,
            global const float4* restrict sampled_colour, global const float* restrict depth,
            global const LightValue* restrict sampled_light, global float4* restrict colour,
            global uint2* restrict info, global LightValue* restrict light,
            global float4* restrict reprojected_colour) {
    const uint width = frame->width, height = frame->height;
    const uint span = 4u * MACULA_PACKETS, items = (width + span - 1u) / span;
    const uint item = (uint)get_global_id(0);
    const uint y0 = item / items * 4u, left = item % items * span;
    if (y0 >= height)
        return;
    const Out out = {colour, info, light};
    const Samples samples = {sampled_colour, depth, sampled_light};
    const Past past = {past_colour, past_info, past_light};
    const Mesh mesh = {{cells, mesh_columns, mesh_rows}, {vertices, mesh_columns, mesh_rows}};
    const uint rows = min(height - y0, 4u), rows_inside = 0x1111u & ((1u << 4u * rows) - 1u);
    const bool any_history = *history_kept != 0u;
    const Steps steps = support_steps(frame, weier);
    Waiting waiting;
    waiting.count = 0u;
    int motion = 0;
    for (uint x0 = left; x0 < min(width, left + span); x0 += 4u) {
        const uint packet = slot_of_pixel(x0, y0, width) / 16u, mask = masks[packet];
        Packet p = {frame, weier, x0, y0, mask & 0xffffu, mask >> 16, 0u, offsets[packet]};
        p.inside = ((1u << min(width - x0, 4u)) - 1u) * rows_inside;
        fetch_ahead(&p, motion, keys, &past, &out);
        const uint rest = reprojected_colour ? p.inside : p.inside & ~p.fresh;
        if (rest == 0u && mask == 0xffffffffu) {
            take_packet(&p, &samples, &out);
            continue;
        }
        const uint16 key = keys_of(keys + y0 * weier->pitch + x0, weier->pitch);
        /* Keys with the bit are to be resampled; MACULA_NO_KEY has it, too. */
        uint known = any_history ? rest & bits_of_lanes16((key & 1u) == 0u) : 0u;
        if (change && known != 0u)
            known &= ~contradicted_lanes(weier, &steps, change, x0, y0);
        uint kept = 0u;
        float16 inverse_depth = (float16)(0.0f);
        if (known != 0u)
            kept = keep_histories(&p, &mesh, &past, key, known, &out, &inverse_depth, &motion);
        if (reprojected_colour)
            for (uint lanes = rest; lanes != 0u; lanes &= lanes - 1u) {
                const uint lane = first_lane(lanes), pixel = pixel_of_lane(&p, lane);
                reprojected_colour[pixel] =
                    (kept >> lane & 1u) != 0u ? colour[pixel] : (float4)(0.0f);
            }
        if (correction && kept != 0u)
            catch_up(weier, &steps, correction, kept, x0, y0, colour, width);
        collect_samples(&p, kept, inverse_depth, &waiting);
        for (uint lanes = p.inside & ~p.sampled & ~kept; lanes != 0u; lanes &= lanes - 1u)
            fill(&p, support_image, first_lane(lanes), &out);
    }
    blend_waiting(weier, frame->frame, &waiting, &samples, &out);
}
