/* The texels of the log-rectilinear buffer, for generate/log_polar.cl. */
#include "lib/log_polar.h"
#include "lib/log_rect.h"

/* Texels on either side of a texel whose pixels may read it, for bilinear interpolation. */
#define READ_FROM 1.0f

/* How many texels along an axis lie within a distance of the gaze, for certain. */
static inline float texels_within(const RectAxis* axis, float inverse_alpha, float gaze,
                                  float distance) {
    const float first = rect_texel(axis, inverse_alpha, gaze - distance);
    const float last = rect_texel(axis, inverse_alpha, gaze + distance);
    return m_max(last - first - 4.0f * READ_FROM, 0.0f);
}

/* A disk that leaves more to trace than the image has pixels covers the image. */
static inline float fitting_radius(global const FrameParams* frame,
                                   global const LogPolarParams* params, float x, float y,
                                   float radius) {
    const RectAxis across = make_rect_axis(x, frame->width, params->width);
    const RectAxis down = make_rect_axis(y, frame->height, params->height);
    const float square = radius * (1.0f - params->fade) * 0x1.6a09e6p-1f;
    const float left_out = texels_within(&across, params->inverse_alpha, x, square) *
                           texels_within(&down, params->inverse_alpha, y, square);
    const float texels = fma((float)params->width, (float)params->height, -left_out);
    const float pixels = (float)frame->width * (float)frame->height;
    const float disk = radius > 0.0f ? MACULA_PI * (radius + 1.0f) * (radius + 1.0f) : 0.0f;
    return m_min(disk, pixels) + texels > pixels && radius > 0.0f ? 1e9f : radius;
}

/* False for texels that no pixel beyond the disk is read from: the furthest corner of what is read
 * from them lies within it. */
static inline bool is_read(global const FrameParams* frame, global const LogPolarParams* params,
                           global const Fovea* fovea, uint column, uint row) {
    const RectAxis across = make_rect_axis(fovea->x, frame->width, params->width);
    const RectAxis down = make_rect_axis(fovea->y, frame->height, params->height);
    const float left = rect_place(&across, params->alpha, (float)column - READ_FROM);
    const float right = rect_place(&across, params->alpha, (float)column + 1.0f + READ_FROM);
    const float top = rect_place(&down, params->alpha, (float)row - READ_FROM);
    const float bottom = rect_place(&down, params->alpha, (float)row + 1.0f + READ_FROM);
    const float x = m_max(fabs(left - fovea->x), fabs(right - fovea->x));
    const float y = m_max(fabs(top - fovea->y), fabs(bottom - fovea->y));
    return distance_of(x, y) >= fovea->inner;
}

static inline Sample sample_at(global const FrameParams* frame, global const LogPolarParams* params,
                               global const Fovea* fovea, float column, float row) {
    const RectAxis across = make_rect_axis(fovea->x, frame->width, params->width);
    const RectAxis down = make_rect_axis(fovea->y, frame->height, params->height);
    Sample s;
    s.x = rect_place(&across, params->alpha, column);
    s.y = rect_place(&down, params->alpha, row);
    s.texel.along = rect_place(&across, params->alpha, column + 0.5f) -
                    rect_place(&across, params->alpha, column - 0.5f);
    s.texel.around =
        rect_place(&down, params->alpha, row + 0.5f) - rect_place(&down, params->alpha, row - 0.5f);
    return s;
}

/* The thesis's bias of texture levels goes by the part of the way to the buffer's nearer edge. */
static inline float lod_column(global const FrameParams* frame, global const LogPolarParams* params,
                               global const Fovea* fovea, float column, float row) {
    const RectAxis across = make_rect_axis(fovea->x, frame->width, params->width);
    const RectAxis down = make_rect_axis(fovea->y, frame->height, params->height);
    return m_max(rect_part(&across, column), rect_part(&down, row)) * (float)params->width;
}
