/* The texels of the log-polar buffer, for generate/log_polar.cl. */
#include "lib/log_polar.h"

typedef struct Texels {
    global const FrameParams* frame;
    global const LogPolarParams* params;
    global const Fovea* fovea;
} Texels;

static inline Texels make_texels(global const FrameParams* frame,
                                 global const LogPolarParams* params, global const Fovea* fovea) {
    const Texels t = {frame, params, fovea};
    return t;
}

/* A disk is drawn as large as it is asked for. */
static inline float fitting_radius(global const FrameParams* frame,
                                   global const LogPolarParams* params, float x, float y,
                                   float radius) {
    return radius;
}

/* Of a place along the radius in texels: its distance from the gaze, and what a texel takes there
 * along the radius and around it, in pixels; the place itself. */
static inline float4 place_across(const Texels* t, float column) {
    const float distance = log_polar_distance(t->params, t->fovea, column);
    const TexelSize texel = log_polar_texel(t->params, t->fovea, column, distance);
    return (float4)(distance, texel.along, texel.around, column);
}

/* Of a place around the gaze: the direction's cosine and sine. */
static inline float4 place_down(const Texels* t, float row) {
    float cosine;
    const float sine = log_polar_direction(t->params, row, &cosine);
    return (float4)(cosine, sine, 0.0f, 0.0f);
}

static inline Sample sample_at(const Texels* t, float4 across, float4 down) {
    const Sample s = {fma(across.x, down.x, t->fovea->x),
                      fma(across.x, down.y, t->fovea->y),
                      {across.y, across.z}};
    return s;
}

/* No pixel beyond the disk is read from the columns before this one. */
static inline uint first_needed(const Texels* t) {
    return t->fovea->first_column;
}

/* False for texels that no pixel beyond the disk is read from. */
static inline bool is_read(const Texels* t, float4 across, float4 down) {
    return true;
}

/* True where some of the texel may lie in the image: each pixel then finds its texel sampled. Half
 * of a texel's diagonal, and a little more for its being bent. */
static inline bool reaches_image(const Texels* t, float4 across, float4 down) {
    const Sample s = sample_at(t, across, down);
    const float reach = 0.6f * distance_of(s.texel.along, s.texel.around);
    return s.x >= -reach && s.y >= -reach && s.x < (float)t->frame->width + reach &&
           s.y < (float)t->frame->height + reach;
}

/* The column that the thesis's bias of texture levels goes by. */
static inline float lod_column(const Texels* t, float4 across, float4 down) {
    return across.w;
}
