/* The texels of the log-polar buffer, for generate/log_polar.cl. */
#include "lib/log_polar.h"

/* A disk is drawn as large as it is asked for. */
static inline float fitting_radius(global const FrameParams* frame,
                                   global const LogPolarParams* params, float x, float y,
                                   float radius) {
    return radius;
}

/* False for texels that no pixel beyond the disk is read from. */
static inline bool is_read(global const FrameParams* frame, global const LogPolarParams* params,
                           global const Fovea* fovea, uint column, uint row) {
    return column >= fovea->first_column;
}

static inline Sample sample_at(global const FrameParams* frame, global const LogPolarParams* params,
                               global const Fovea* fovea, float column, float row) {
    const float distance = log_polar_distance(params, fovea, column);
    float cosine;
    const float sine = log_polar_direction(params, row, &cosine);
    Sample s;
    s.x = fma(distance, cosine, fovea->x);
    s.y = fma(distance, sine, fovea->y);
    s.texel = log_polar_texel(params, fovea, column, distance);
    return s;
}

/* The column that the thesis's bias of texture levels goes by. */
static inline float lod_column(global const FrameParams* frame, global const LogPolarParams* params,
                               global const Fovea* fovea, float column, float row) {
    return column;
}
