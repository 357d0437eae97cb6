/* Where pixels lie in the log-rectilinear buffer, for remap/log_polar_surface.cl. */
#include "lib/log_rect.h"

/* `x`, `y`: from the gaze. */
static inline Place place_in_buffer(global const FrameParams* frame,
                                    global const LogPolarParams* params, global const Fovea* fovea,
                                    Real x, Real y, Real distance) {
    const RectAxis across = make_rect_axis(fovea->x, frame->width, params->width);
    const RectAxis down = make_rect_axis(fovea->y, frame->height, params->height);
    const Real column = rect_texel(&across, params->inverse_alpha, x + fovea->x);
    const Real row = rect_texel(&down, params->inverse_alpha, y + fovea->y);
    const Real zero = splat(0.0f), last_column = splat((float)(params->width - 1u));
    const Real last_row = splat((float)(params->height - 1u));
    const Place p = {clamped(column - (frame->jitter[0] + 0.5f), zero, last_column),
                     clamped(row - (frame->jitter[1] + 0.5f), zero, last_row)};
    return p;
}

/* The buffer ends where the image does: the row of a texel one beyond its ends. */
static inline uint row_of_texels(global const LogPolarParams* params, int row) {
    return (uint)clamp(row, 0, (int)params->height - 1);
}

/* The index of a texel. */
static inline Uint texel_at(global const LogPolarParams* params, Int column, Int row) {
    const Int last = splat_int((int)params->height - 1);
    const Int kept = min(max(row, splat_int(0)), last);
    return int_to_uint(kept * (int)params->pitch + column + 1);
}
