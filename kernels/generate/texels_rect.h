/* The texels of the log-rectilinear buffer, for generate/log_polar.cl. */
#include "lib/log_polar.h"
#include "lib/log_rect.h"

/* Texels on either side of a texel whose pixels may read it: one for bilinear interpolation, and
 * half of one for jitter. */
#define READ_FROM 1.5f

/* From the first of an axis's texels to the last one that may touch a disk. */
typedef struct Span {
    float first, last;
} Span;

typedef struct Texels {
    global const LogPolarParams* params;
    global const Fovea* fovea;
    RectAxis across, down;
} Texels;

static inline Span span_of_disk(const RectAxis* axis, float inverse_alpha, float gaze,
                                float radius) {
    const Span span = {rect_texel(axis, inverse_alpha, gaze - radius),
                       rect_texel(axis, inverse_alpha, gaze + radius)};
    return span;
}

static inline Texels make_texels(global const FrameParams* frame,
                                 global const LogPolarParams* params, global const Fovea* fovea) {
    Texels t;
    t.params = params;
    t.fovea = fovea;
    t.across = make_rect_axis(fovea->x, frame->width, params->width);
    t.down = make_rect_axis(fovea->y, frame->height, params->height);
    return t;
}

/* How many texels along an axis lie within a distance of the gaze, for certain. */
static inline float texels_within(const RectAxis* axis, float inverse_alpha, float gaze,
                                  float distance) {
    const Span span = span_of_disk(axis, inverse_alpha, gaze, distance);
    return m_max(span.last - span.first - 4.0f * READ_FROM, 0.0f);
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

/* Of a place along an axis in texels: where it lies and what a texel takes there, in pixels; how
 * far from the gaze the furthest pixel is that is read from the texel around it; the part of the
 * way to the buffer's end. */
static inline float4 place_along(const RectAxis* axis, float alpha, float gaze, float texel) {
    const RectPlace p = rect_place(axis, alpha, texel);
    const float first = floor(texel);
    const float before = rect_place(axis, alpha, first - READ_FROM).place;
    const float behind = rect_place(axis, alpha, first + 1.0f + READ_FROM).place;
    return (float4)(p.place, p.size, m_max(fabs(before - gaze), fabs(behind - gaze)),
                    rect_part(axis, texel));
}

static inline float4 place_across(const Texels* t, float column) {
    return place_along(&t->across, t->params->alpha, t->fovea->x, column);
}

static inline float4 place_down(const Texels* t, float row) {
    return place_along(&t->down, t->params->alpha, t->fovea->y, row);
}

static inline Sample sample_at(const Texels* t, float4 across, float4 down) {
    const Sample s = {across.x, down.x, {across.y, down.y}};
    return s;
}

static inline uint first_needed(const Texels* t) {
    return 0u;
}

/* False for texels that no pixel beyond the disk is read from: the furthest corner of what is read
 * from them lies within it. */
static inline bool is_read(const Texels* t, float4 across, float4 down) {
    return distance_of(across.z, down.z) >= t->fovea->inner;
}

/* All texels lie in the image. */
static inline bool reaches_image(const Texels* t, float4 across, float4 down) {
    return true;
}

/* The thesis's bias of texture levels goes by the part of the way to the buffer's nearer edge. */
static inline float lod_column(const Texels* t, float4 across, float4 down) {
    return m_max(across.w, down.w) * (float)t->params->width;
}
