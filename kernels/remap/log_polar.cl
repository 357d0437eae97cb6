/* From the samples of kernel log-polar foveation to the image (Mrad 2022, sections 4.2.2, 4.2.3).
 */
#include "lib/camera.h"
#include "lib/log_polar.h"
#include "remap/weights.h"
#include "shared/ray.h"

#define MACULA_TAPS 3
#include "remap/taps.h"

/* One work-item a slot: samples of the disk go to their pixels, the others to the buffer: times
 * their weights, which alpha holds. */
kernel void place_samples(global const FrameParams* restrict frame,
                          global const uint* restrict ray_count, global const uint* restrict places,
                          global const float4* restrict colours, global float4* restrict image,
                          global float4* restrict buffer) {
    const uint slot = (uint)get_global_id(0);
    if (slot >= *ray_count || places[slot] == MACULA_NO_PIXEL)
        return;
    const uint pixels = frame->width * frame->height, place = places[slot];
    const float4 colour = (float4)(colours[slot].xyz, 1.0f);
    if (place < pixels)
        image[place] = colour;
    else
        buffer[place - pixels] = colour * weight_of_sample(colour.xyz);
}

/* `column`, `row`: of the buffer, in texels, 0 being the edge of the first one. The buffer goes on
 * around the gaze. Returns how near the middle sample lies. */
static inline Real put_taps(Real column, Real row, global const LogPolarParams* params,
                            Taps* taps) {
    const Real last = splat((float)(params->width - 1u));
    const Real middle_column = m_min(rint(column - 0.5f), last), middle_row = rint(row - 0.5f);
    const Real to_x = column - 0.5f - middle_column, to_y = row - 0.5f - middle_row;
    tap_weights(to_x, taps->columns);
    Real weights[MACULA_TAPS];
    tap_weights(to_y, weights);
    /* The column before the middle one: a row begins with an empty texel. */
    const Int first_column = to_int(middle_column), rows = splat_int((int)params->height);
    for (int j = 0; j < MACULA_TAPS; ++j) {
        const Int wrapped = to_int(middle_row) + (j - 1);
        const Int below = wrapped < 0 ? wrapped + rows : wrapped;
        const Int kept = below >= rows ? below - rows : below;
        put_row(taps, j, int_to_uint(kept * (int)params->pitch + first_column), weights[j]);
    }
    return nearness(to_x) * nearness(to_y);
}

/* One work-item a strip. Within the disk the image holds its samples, which pass into the buffer's
 * colours towards the edge. Alpha: 1 where a sample lies in a pixel's middle. */
kernel void remap_log_polar(global const FrameParams* restrict frame,
                            global const LogPolarParams* restrict params,
                            global const Fovea* restrict fovea,
                            global const float4* restrict buffer, global float4* restrict image) {
    const Strip s = strip_of_item(frame->width, frame->height);
    if (s.y >= s.height)
        return;
    const Real x = strip_middles(&s) - splat(fovea->x);
    const Real y = splat(((float)s.y + 0.5f) - fovea->y);
    const Real distance = m_sqrt(fma(x, x, y * y));
    const Mask wanted = strip_inside(&s) & (distance >= splat(fovea->inner));
    if (!any_lane(wanted))
        return;
    /* Lanes within the disk read the buffer in vain: where it begins. */
    const Real kept = m_max(distance, splat(fovea->inner));
    Taps taps;
    /* The samples lie in the buffer where the frame's jitter put them. */
    const Real column = log_polar_column(params, fovea, kept) - frame->jitter[0];
    const Real near =
        put_taps(clamped(column, splat(0.0f), splat((float)params->width)),
                 log_polar_row(params, x, y) - frame->jitter[1], params, &taps);
    store_remapped(fovea, &s, distance, wanted, read_taps(buffer, &taps), near, image);
}
