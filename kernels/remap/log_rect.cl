/* From the samples of log-rectilinear foveation to the image (Li et al. 2021): pixels beyond the
 * foveal disk are interpolated between two by two texels of the buffer. */
#include "lib/camera.h"
#include "lib/log_polar.h"
#include "lib/log_rect.h"
#include "remap/weights.h"
#include "shared/ray.h"

#define MACULA_TAPS 2
#include "remap/taps.h"

/* The first of the two texels between which a place lies, 0 being the buffer's first edge. */
static inline Real first_of_two(Real place, Real* second) {
    const Real first = floor(place - 0.5f);
    *second = (place - 0.5f) - first;
    return first;
}

/* How near the nearest sample lies. */
static inline Real nearness_along(Real place) {
    const Real texel = place - splat(0.5f);
    return nearness(texel - rint(texel));
}

/* Beyond the ends of the buffer its outermost texels go on; its rows begin and end with an empty
 * one, which then counts nothing. */
static inline void put_taps(Real column, Real row, global const LogPolarParams* params,
                            Taps* taps) {
    const Real half_texel = splat(0.5f), one = splat(1.0f);
    const Real last_column = splat((float)params->width - 0.5f);
    const Real last_row = splat((float)params->height - 0.5f);
    Real across, down;
    const Int left = to_int(first_of_two(clamped(column, half_texel, last_column), &across));
    const Int top = to_int(first_of_two(clamped(row, half_texel, last_row), &down));
    const Int below = min(top + 1, splat_int((int)params->height - 1));
    taps->columns[0] = one - across;
    taps->columns[1] = across;
    put_row(taps, 0, int_to_uint(top * (int)params->pitch + left + 1), one - down);
    put_row(taps, 1, int_to_uint(below * (int)params->pitch + left + 1), down);
}

/* One work-item a strip. Within the disk the image holds its samples, which pass into the buffer's
 * colours towards the edge. Alpha: 1 where a sample lies in a pixel's middle. */
kernel void remap_log_rect(global const FrameParams* restrict frame,
                           global const LogPolarParams* restrict params,
                           global const Fovea* restrict fovea, global const float4* restrict buffer,
                           global float4* restrict image) {
    const Strip s = strip_of_item(frame->width, frame->height);
    if (s.y >= s.height)
        return;
    const Real x = strip_middles(&s), y = splat((float)s.y + 0.5f);
    const Real dx = x - splat(fovea->x), dy = y - splat(fovea->y);
    const Real distance = m_sqrt(fma(dx, dx, dy * dy));
    const Mask wanted = strip_inside(&s) & (distance >= splat(fovea->inner));
    if (!any_lane(wanted))
        return;
    const RectAxis columns = make_rect_axis(fovea->x, frame->width, params->width);
    const RectAxis rows = make_rect_axis(fovea->y, frame->height, params->height);
    Taps taps;
    /* The samples lie in the buffer where the frame's jitter put them. */
    const Real column = rect_texel(&columns, params->inverse_alpha, x) - frame->jitter[0];
    const Real row = rect_texel(&rows, params->inverse_alpha, y) - frame->jitter[1];
    put_taps(column, row, params, &taps);
    store_remapped(fovea, &s, distance, wanted, read_taps(buffer, &taps),
                   nearness_along(column) * nearness_along(row), image);
}
