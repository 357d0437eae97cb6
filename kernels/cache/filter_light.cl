/* The post-processor (Weier et al. 2016, section 3.5): resampled pixels have one frame's noise in
 * their light, their neighbours that of many. Each takes the light buffer's value of the nearest
 * reconstructed neighbour that a random search finds. It runs on the list, before the samples are
 * shaded, so that no shading is undone. */
#include "cache/light_value.h"
#include "lib/acuity.h"
#include "lib/camera.h"
#include "lib/random_vector.h"
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

#define NO_TEXEL (-1)

/* The texel of last frame's light that a reconstructed pixel shows; NO_TEXEL where that belongs to
 * another surface. */
static inline int texel_of(const Search* s, float depth, int x, int y) {
    const uint key = s->keys[(uint)y * s->weier->pitch + (uint)x];
    const History h = find_history(&s->mesh, s->weier, key, (float)x + 0.5f, (float)y + 0.5f);
    const float apart = fabs(fma(depth, h.inverse_depth, -1.0f));
    if (!h.found || !(apart <= s->weier->merge_threshold))
        return NO_TEXEL;
    return (int)texel_index((int)rint(floor(h.at.x)), (int)rint(floor(h.at.y)), s->frame->width,
                            s->frame->height);
}

/* random_unit() of lib/random.h for eight tries from `first` on, in two dimensions. */
static inline float16 random_places(uint key, uint first) {
    const uint16 sample = first + (as_uint16(MACULA_LANES16) & 7u);
    const uint16 dimension = MACULA_DIMENSION_LIGHT_FILTER + (as_uint16(MACULA_LANES16) >> 3);
    const uint16 bits =
        random_mix(key ^ random_mix(sample * 0x9e3779b1u + dimension * 0x85ebca77u));
    return convert_float16(bits >> 8) * 0x1p-24f;
}

static inline uint least_lane8(uint8 v) {
    const uint4 a = min(v.lo, v.hi);
    const uint2 b = min(a.lo, a.hi);
    return min(b.x, b.y);
}

/* A pixel that looks for light. */
typedef struct Seeker {
    int x, y;
    float depth;
    uint random;  /* key of its numbers */
    int lit_only; /* 0: whether the light is any is left to the caller */
} Seeker;

#define NO_CANDIDATE 0xffffffffu

/* The texel of the nearest of eight places, from try `first` on, in the square that reaches
 * `window` pixels far; of several as near the first. `least`: squared distance that counts no more;
 * lowered to that of the one found. */
static inline int nearest_of_eight(const Search* s, const Seeker* seeker, int window, uint first,
                                   int* least) {
    const float reach = (float)(2 * window + 1);
    const int16 steps = convert_int16(floor(random_places(seeker->random, first) * reach)) - window;
    const int8 dx = steps.lo, dy = steps.hi;
    const int8 distance = dx * dx + dy * dy, at_x = seeker->x + dx, at_y = seeker->y + dy;
    const uint8 tries = first + (uint8)(0, 1, 2, 3, 4, 5, 6, 7);
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
        const int texel = texel_of(s, seeker->depth, column[next & 7u], row[next & 7u]);
        if (texel != NO_TEXEL && (seeker->lit_only == 0 || is_lit(s->past_light[texel]))) {
            *least = (int)(next >> 3);
            return texel;
        }
        order = order == next ? (uint8)(NO_CANDIDATE) : order;
    }
    return NO_TEXEL;
}

static inline Seeker seeker_of(global const FrameParams* frame, uint sample, int x, int y,
                               float depth, int lit_only) {
    const uint pixel = (uint)y * frame->width + (uint)x;
    Seeker seeker;
    seeker.x = x;
    seeker.y = y;
    seeker.depth = depth;
    seeker.random = random_mix(random_key(pixel, frame->frame, frame->seed) + sample);
    seeker.lit_only = lit_only;
    return seeker;
}

static inline int nearest_texel(const Search* s, const Seeker* seeker) {
    const int window = window_of(s, seeker->x, seeker->y);
    int best = NO_TEXEL, least = 0x7fffffff;
    for (uint k = 0u; window > 0 && k < s->weier->filter_tries; k += 8u) {
        const int found = nearest_of_eight(s, seeker, window, k, &least);
        best = found != NO_TEXEL ? found : best;
    }
    return best;
}

/* Lanes outside of r0. */
static inline int16 outside_fovea(global const FrameParams* frame, global const WeierParams* weier,
                                  int16 x, int16 y) {
    global const Camera* camera = &frame->camera;
    const float3 gaze = vector_at(frame->gaze);
    const float right = dot3(gaze, vector_at(camera->right)),
                up = dot3(gaze, vector_at(camera->up));
    const float forward = dot3(gaze, vector_at(camera->forward));
    const float step_x = m_divide(camera->tan_right + camera->tan_left, (float)frame->width);
    const float step_y = m_divide(camera->tan_up + camera->tan_down, (float)frame->height);
    const float16 sx =
        fma(convert_float16(x) + 0.5f, (float16)(step_x), (float16)(-camera->tan_left));
    const float16 sy =
        fma(convert_float16(y) + 0.5f, (float16)(-step_y), (float16)(camera->tan_up));
    const float16 along = fma((float16)(right), sx, fma((float16)(up), sy, (float16)(forward)));
    const float16 squared = fma(sx, sx, fma(sy, sy, (float16)(1.0f)));
    const float r0 = weier->r0 * frame->gaze_widening;
    return along * m_inverse_sqrt(squared) < cosine_of_eccentricity(r0);
}

/* Rows of pixels' indices: a quotient by way of floats, put right by the remainder. */
static inline int16 rows_of(int16 pixel, uint width) {
    const int16 guess = convert_int16(convert_float16(pixel) * m_divide(1.0f, (float)width));
    const int16 rest = pixel - guess * (int)width;
    return guess + (rest < 0) - (rest >= (int)width);
}

/* Noise is smaller than MOST_NOISE; a shadow's edge or a turn of the surface is not. */
static inline bool is_noise(LightValue here, LightValue there) {
    const float a = strength_of(here), b = strength_of(there);
    return is_lit(there) && fabs(a - b) <= MOST_NOISE * m_max(a, b);
}

/* Lanes of `bits` whose neighbours' light is not that of another time: something moved there. */
static inline uint unchanged_lanes(global const WeierParams* weier, global const uint* errors,
                                   uint16 key, uint bits) {
    uint keys[16], kept = 0u;
    vstore16(key, 0, keys);
    for (uint lanes = bits; lanes != 0u; lanes &= lanes - 1u) {
        const uint k = keys[first_lane(lanes)], cell = cell_of_key(k, weier);
        const uint i = cell & ((1u << weier->cell_bits_x) - 1u), j = cell >> weier->cell_bits_x;
        const bool changed =
            k != MACULA_NO_KEY &&
            (errors[j * weier->support_width + i] & MACULA_RESAMPLE_CHANGED) != 0u;
        kept |= changed ? 0u : lanes & -lanes;
    }
    return kept;
}

/* One work-item sixteen slots of the list. All of them search before the first light is read, so
 * that they wait for memory together. errors: the resampling info, null where nothing ever moves.
 */
kernel void
filter_light(global const FrameParams* restrict frame, global const WeierParams* restrict weier,
             uint sample, global const float* restrict mesh_columns,
             global const float* restrict mesh_rows, global const float4* restrict vertices,
             global const uint* restrict keys, global const uint* restrict history_kept,
             global const uint* restrict errors, global const LightValue* restrict past_light,
             global const uint* restrict ray_count,
             global const uint* restrict pixels, global const float* restrict depth,
             global const LightValue* restrict light, global LightValue* restrict filtered) {
    const uint first = (uint)get_global_id(0) * 16u;
    if (first >= *ray_count)
        return;
    for (uint lane = 0u; lane < 16u; ++lane)
        filtered[first + lane] = light[first + lane];
    if (*history_kept == 0u)
        return;
    const uint16 pixel = vload16(0, pixels + first);
    const int16 used = pixel != MACULA_NO_PIXEL;
    const int16 place = used ? as_int16(pixel) : (int16)(0);
    const int16 y = rows_of(place, frame->width), x = place - y * (int)frame->width;
    const int16 i = y * (int)weier->pitch + x;
    const uint16 key =
        (uint16)(keys[i.s0], keys[i.s1], keys[i.s2], keys[i.s3], keys[i.s4], keys[i.s5], keys[i.s6],
                 keys[i.s7], keys[i.s8], keys[i.s9], keys[i.sa], keys[i.sb], keys[i.sc], keys[i.sd],
                 keys[i.se], keys[i.sf]);
    int16 resampled =
        used & ((key & 1u) != 0u) & (vload16(0, depth + first) < MACULA_BACKGROUND_DEPTH);
    if (weier->resample_new == 0u)
        resampled &= key != MACULA_NO_KEY;
    uint seeking = bits_of_lanes16(resampled);
    if (seeking == 0u)
        return;
    seeking &= bits_of_lanes16(outside_fovea(frame, weier, x, y));
    if (errors)
        seeking = unchanged_lanes(weier, errors, key, seeking);

    const Search s = {frame, weier, keys, past_light, {vertices, mesh_columns, mesh_rows}};
    int column[16], row[16], texel[16];
    vstore16(x, 0, column);
    vstore16(y, 0, row);
    for (uint lanes = seeking; lanes != 0u; lanes &= lanes - 1u) {
        const uint lane = first_lane(lanes);
        const Seeker seeker =
            seeker_of(frame, sample, column[lane], row[lane], depth[first + lane], 0);
        texel[lane] = nearest_texel(&s, &seeker);
        MACULA_FETCH(past_light, (long)texel[lane] * (long)sizeof(LightValue));
    }
    for (uint lanes = seeking; lanes != 0u; lanes &= lanes - 1u) {
        const uint lane = first_lane(lanes);
        if (texel[lane] == NO_TEXEL)
            continue;
        LightValue found = past_light[texel[lane]];
        if (!is_lit(found)) {
            const Seeker seeker =
                seeker_of(frame, sample, column[lane], row[lane], depth[first + lane], 1);
            const int other = nearest_texel(&s, &seeker);
            found = other != NO_TEXEL ? past_light[other] : UNLIT;
        }
        if (is_noise(light[first + lane], found))
            filtered[first + lane] = found;
    }
}
