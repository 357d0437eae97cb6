/* Where pixels lie in the log-polar buffer, for remap/log_polar_surface.cl. */

/* `x`, `y`: from the gaze. */
static inline Place place_in_buffer(global const FrameParams* frame,
                                    global const LogPolarParams* params, global const Fovea* fovea,
                                    Real x, Real y, Real distance) {
    const Real last = splat((float)(params->width - 1u)), half_texel = splat(0.5f);
    const Real first = splat((float)min(fovea->first_column, params->width - 1u));
    const Real column = log_polar_column(params, fovea, distance) - splat(frame->jitter[0]);
    const Place p = {clamped(column - half_texel, first, last),
                     log_polar_row(params, x, y) - splat(frame->jitter[1]) - half_texel};
    return p;
}

/* The buffer goes on around the gaze: the row of a texel one beyond its ends. */
static inline uint row_of_texels(global const LogPolarParams* params, int row) {
    const int rows = (int)params->height;
    return (uint)(row < 0 ? row + rows : (row >= rows ? row - rows : row));
}

/* The index of a texel. */
static inline Uint texel_at(global const LogPolarParams* params, Int column, Int row) {
    const Int rows = splat_int((int)params->height);
    const Int below = row < 0 ? row + rows : row;
    const Int kept = below >= rows ? below - rows : below;
    return int_to_uint(kept * (int)params->pitch + column + 1);
}
