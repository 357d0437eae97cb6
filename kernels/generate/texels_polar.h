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

/* False for texels that no pixel beyond the disk is read from. */
static inline bool is_read(const Texels* t, uint column, uint row) {
    return column >= t->fovea->first_column;
}

static inline Sample sample_at(const Texels* t, float column, float row) {
    const float distance = log_polar_distance(t->params, t->fovea, column);
    float cosine;
    const float sine = log_polar_direction(t->params, row, &cosine);
    Sample s;
    s.x = fma(distance, cosine, t->fovea->x);
    s.y = fma(distance, sine, t->fovea->y);
    s.texel = log_polar_texel(t->params, t->fovea, column, distance);
    return s;
}

/* True where some of the texel may lie in the image: each pixel then finds its texel sampled. Half
 * of a texel's diagonal, and a little more for its being bent. */
static inline bool reaches_image(const Texels* t, uint column, uint row) {
    const Sample s = sample_at(t, (float)column + 0.5f, (float)row + 0.5f);
    const float reach = 0.6f * distance_of(s.texel.along, s.texel.around);
    return s.x >= -reach && s.y >= -reach && s.x < (float)t->frame->width + reach &&
           s.y < (float)t->frame->height + reach;
}

/* The column that the thesis's bias of texture levels goes by. */
static inline float lod_column(const Texels* t, float column, float row) {
    return column;
}
