/* The post-processor (Weier et al. 2016, section 3.5): resampled pixels have one frame's noise in
 * their light, their neighbours that of many. Each takes the light buffer's value of the nearest
 * reconstructed neighbour that a random search finds. It runs on the list, before the samples are
 * shaded, so that no shading is undone. */
#include "cache/light_value.h"
#include "lib/acuity.h"
#include "lib/camera.h"
#include "lib/reprojection.h"
#include "lib/simd.h"

/* Of the light: part of the stronger of two values. */
#define MOST_NOISE 0.4f

typedef struct Search {
    global const FrameParams* frame;
    global const WeierParams* weier;
    global const uint* keys;
    global const LightValue* past_light;
    MeshTables mesh;
    float depth; /* of the sample */
} Search;

/* Reconstructed from the cache rather than resampled. MACULA_NO_KEY is odd, too. */
static inline bool is_reconstructed(const Search* s, int x, int y) {
    if (x < 0 || y < 0 || x >= (int)s->frame->width || y >= (int)s->frame->height)
        return false;
    return (s->keys[(uint)y * s->weier->pitch + (uint)x] & 1u) == 0u;
}

/* Bit n: the pixel x + n of row y is reconstructed, n < 16. Needs 0 <= x. */
static inline uint reconstructed_from(const Search* s, int x, int y) {
    const int16 lanes = x + MACULA_LANES16;
    const uint16 keys = vload16(0, s->keys + (uint)y * s->weier->pitch + (uint)x);
    return bits_of_lanes16(((keys & 1u) == 0u) & (lanes < (int)s->frame->width));
}

/* Pixels to the nearest reconstructed neighbour in the row, above `farthest` where none is nearer.
 */
static inline int distance_in_row(const Search* s, int x, int y, int farthest) {
    int d = 1;
    for (; x - d - 15 >= 0 && x + d + 16 <= (int)s->weier->pitch && d <= farthest; d += 16) {
        /* To the left the nearest is bit 15. */
        const uint left = reconstructed_from(s, x - d - 15, y),
                   right = reconstructed_from(s, x + d, y);
        if ((left | right) != 0u)
            return d + (int)min(clz(left << 16 | 1u), popcount((right & -right) - 1u));
    }
    while (d <= farthest && !is_reconstructed(s, x - d, y) && !is_reconstructed(s, x + d, y))
        ++d;
    return d;
}

/* Pixels to the nearest reconstructed neighbour along the axes; 0: there is none. */
static inline int window_of(const Search* s, int x, int y) {
    const int farthest = (int)s->weier->filter_window;
    const int found = distance_in_row(s, x, y, farthest);
    int d = 1;
    while (d < found && d <= farthest && !is_reconstructed(s, x, y - d) &&
           !is_reconstructed(s, x, y + d))
        ++d;
    return d <= farthest ? d : 0;
}

/* The reprojected light of a reconstructed pixel, unlit where it belongs to another surface. */
static inline LightValue light_of(const Search* s, int x, int y) {
    const uint key = s->keys[(uint)y * s->weier->pitch + (uint)x];
    const History h = find_history(&s->mesh, s->weier, key, (float)x + 0.5f, (float)y + 0.5f);
    const float same = fabs(fma(s->depth, h.inverse_depth, -1.0f));
    if (!h.found || !(same <= s->weier->merge_threshold))
        return UNLIT;
    return kept_light(s->past_light[texel_index((int)rint(floor(h.at.x)), (int)rint(floor(h.at.y)),
                                                s->frame->width, s->frame->height)]);
}

static inline uint8 random_mix8(uint8 x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}

/* random_unit() of lib/random.h for eight samples. */
static inline float8 random_units(uint key, uint8 sample, uint dimension) {
    const uint8 bits =
        random_mix8(key ^ random_mix8(sample * 0x9e3779b1u + dimension * 0x85ebca77u));
    return convert_float8(bits >> 8) * 0x1p-24f;
}

static inline uint least_lane8(uint8 v) {
    const uint4 a = min(v.lo, v.hi);
    const uint2 b = min(a.lo, a.hi);
    return min(b.x, b.y);
}

#define NO_CANDIDATE 0xffffffffu

/* The light of the nearest of up to eight places, tried from the nearest on; of several as near the
 * first. Places: eight tries from `first` on, in the square around x, y that reaches `window`
 * pixels far. `least`: squared distance that counts no more; lowered to the one found. */
static inline LightValue nearest_of_eight(const Search* s, int x, int y, int window, uint random,
                                          uint first, int* least) {
    const uint8 tries = first + (uint8)(0, 1, 2, 3, 4, 5, 6, 7);
    const float reach = (float)(2 * window + 1);
    const float8 u = random_units(random, tries, MACULA_DIMENSION_LIGHT_FILTER);
    const float8 v = random_units(random, tries, MACULA_DIMENSION_LIGHT_FILTER + 1u);
    const int8 dx = convert_int8(floor(u * reach)) - window;
    const int8 dy = convert_int8(floor(v * reach)) - window;
    const int8 distance = dx * dx + dy * dy, at_x = x + dx, at_y = y + dy;
    const int8 wanted = (at_x >= 0) & (at_y >= 0) & (at_x < (int)s->frame->width) &
                        (at_y < (int)s->frame->height) & (distance < *least) &
                        (tries < s->weier->filter_tries);
    const int8 index = wanted ? at_y * (int)s->weier->pitch + at_x : (int8)(0);
    const global uint* k = s->keys;
    const uint8 keys = (uint8)(k[index.s0], k[index.s1], k[index.s2], k[index.s3], k[index.s4],
                               k[index.s5], k[index.s6], k[index.s7]);
    const int8 candidate = wanted & ((keys & 1u) == 0u);
    uint8 order = candidate ? as_uint8(distance) * 8u + (tries & 7u) : (uint8)(NO_CANDIDATE);
    int column[8], row[8];
    vstore8(at_x, 0, column);
    vstore8(at_y, 0, row);
    for (uint next = least_lane8(order); next != NO_CANDIDATE; next = least_lane8(order)) {
        const LightValue found = light_of(s, column[next & 7u], row[next & 7u]);
        if (is_lit(found)) {
            *least = (int)(next >> 3);
            return found;
        }
        order = order == next ? (uint8)(NO_CANDIDATE) : order;
    }
    return UNLIT;
}

static inline LightValue search(const Search* s, int x, int y, uint random) {
    const int window = window_of(s, x, y);
    LightValue best = UNLIT;
    int least = 0x7fffffff;
    for (uint k = 0u; window > 0 && k < s->weier->filter_tries; k += 8u) {
        const LightValue found = nearest_of_eight(s, x, y, window, random, k, &least);
        best = is_lit(found) ? found : best;
    }
    return best;
}

static inline bool in_fovea(global const FrameParams* frame, global const WeierParams* weier,
                            uint x, uint y) {
    const float3 direction = camera_direction(&frame->camera, frame->width, frame->height,
                                              (float)x + 0.5f, (float)y + 0.5f);
    const float cosine =
        dot3(direction, vector_at(frame->gaze)) * m_inverse_sqrt(dot3(direction, direction));
    return cosine >= cosine_of_eccentricity(weier->r0 * frame->gaze_widening);
}

/* One work-item a slot of the list. */
kernel void
filter_light(global const FrameParams* restrict frame, global const WeierParams* restrict weier,
             uint sample, global const float* restrict mesh_columns,
             global const float* restrict mesh_rows, global const float4* restrict vertices,
             global const uint* restrict keys, global const uint* restrict history_kept,
             global const LightValue* restrict past_light, global const uint* restrict ray_count,
             global const uint* restrict pixels, global const float* restrict depth,
             global const LightValue* restrict light, global LightValue* restrict filtered) {
    const uint slot = (uint)get_global_id(0);
    if (slot >= *ray_count)
        return;
    filtered[slot] = light[slot];
    const uint pixel = pixels[slot];
    if (pixel == MACULA_NO_PIXEL || *history_kept == 0u)
        return;
    const uint y = pixel / frame->width, x = pixel - y * frame->width;
    const Search s = {frame,      weier, keys, past_light, {vertices, mesh_columns, mesh_rows},
                      depth[slot]};
    const uint key = keys[y * weier->pitch + x];
    const bool resampled = (key & 1u) != 0u && (key != MACULA_NO_KEY || weier->resample_new != 0u);
    if (!resampled || in_fovea(frame, weier, x, y) || s.depth >= MACULA_BACKGROUND_DEPTH)
        return;
    const uint random = random_mix(random_key(pixel, frame->frame, frame->seed) + sample);
    const LightValue found = search(&s, (int)x, (int)y, random);
    /* Noise is smaller than this; a shadow's edge or a turn of the surface is not. */
    const float here = strength_of(light[slot]), there = strength_of(found);
    if (is_lit(found) && fabs(here - there) <= MOST_NOISE * m_max(here, there))
        filtered[slot] = found;
}
