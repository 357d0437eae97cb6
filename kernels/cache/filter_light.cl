/* The post-processor (Weier et al. 2016, section 3.5): resampled pixels have one frame's noise in
 * their light, their neighbours that of many. Each takes the light buffer's value of the nearest
 * reconstructed neighbour that a random search finds. It runs on the list, before the samples are
 * shaded, so that no shading is undone. */
#include "cache/light_value.h"
#include "lib/acuity.h"
#include "lib/camera.h"
#include "lib/reprojection.h"

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

static inline uint key_at(const Search* s, int x, int y) {
    if (x < 0 || y < 0 || x >= (int)s->frame->width || y >= (int)s->frame->height)
        return MACULA_NO_KEY;
    return s->keys[(uint)y * s->weier->pitch + (uint)x];
}

/* Reconstructed from the cache rather than resampled. MACULA_NO_KEY is odd, too. */
static inline bool is_reconstructed(const Search* s, int x, int y) {
    return (key_at(s, x, y) & 1u) == 0u;
}

/* Pixels to the nearest reconstructed neighbour along the axes; 0: there is none. */
static inline int window_of(const Search* s, int x, int y) {
    for (int d = 1; d <= (int)s->weier->filter_window; ++d)
        if (is_reconstructed(s, x - d, y) || is_reconstructed(s, x + d, y) ||
            is_reconstructed(s, x, y - d) || is_reconstructed(s, x, y + d))
            return d;
    return 0;
}

/* The reprojected light of a reconstructed pixel, unlit where it belongs to another surface. */
static inline LightValue light_of(const Search* s, int x, int y) {
    const History h =
        find_history(&s->mesh, s->weier, key_at(s, x, y), (float)x + 0.5f, (float)y + 0.5f);
    const float same = fabs(fma(s->depth, h.inverse_depth, -1.0f));
    if (!h.found || !(same <= s->weier->merge_threshold))
        return UNLIT;
    return kept_light(s->past_light[texel_index((int)rint(floor(h.at.x)), (int)rint(floor(h.at.y)),
                                                s->frame->width, s->frame->height)]);
}

static inline LightValue search(const Search* s, int x, int y, uint random) {
    const int window = window_of(s, x, y);
    const float reach = (float)(2 * window + 1);
    LightValue best = UNLIT;
    int least = 0x7fffffff;
    for (uint k = 0u; window > 0 && k < s->weier->filter_tries; ++k) {
        const float u = random_unit(random, k, MACULA_DIMENSION_LIGHT_FILTER);
        const float v = random_unit(random, k, MACULA_DIMENSION_LIGHT_FILTER + 1u);
        const int dx = (int)rint(floor(u * reach)) - window;
        const int dy = (int)rint(floor(v * reach)) - window;
        const int distance = dx * dx + dy * dy;
        if (distance >= least || !is_reconstructed(s, x + dx, y + dy))
            continue;
        const LightValue found = light_of(s, x + dx, y + dy);
        if (is_lit(found)) {
            best = found;
            least = distance;
        }
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
    const uint key = key_at(&s, (int)x, (int)y);
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
