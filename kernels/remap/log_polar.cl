/* From the samples of kernel log-polar foveation to the image (Mrad 2022, sections 4.2.2, 4.2.3).
 */
#include "lib/camera.h"
#include "lib/lane_array.h"
#include "lib/log_polar.h"
#include "remap/weights.h"
#include "shared/ray.h"

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

/* What the lanes read: three weights along an axis, and for each row the index of its first texel.
 */
typedef struct Taps {
    float columns[3][MACULA_LANES], rows[3][MACULA_LANES];
    uint first[3][MACULA_LANES];
} Taps;

static inline Real put_weights(Real place, Real middle, float weights[3][MACULA_LANES]) {
    Real w[3];
    tap_weights(place - middle, w);
    for (int i = 0; i < 3; ++i)
        put_lanes(weights[i], w[i]);
    return nearness(place - middle);
}

/* `column`, `row`: of the buffer, in texels, 0 being the edge of the first one. The buffer goes on
 * around the gaze. Returns how near the middle sample lies. */
static inline Real put_taps(Real column, Real row, global const LogPolarParams* params,
                            Taps* taps) {
    const Real last = splat((float)(params->width - 1u));
    const Real middle_column = m_min(rint(column - 0.5f), last), middle_row = rint(row - 0.5f);
    const Real across = put_weights(column - 0.5f, middle_column, taps->columns);
    const Real down = put_weights(row - 0.5f, middle_row, taps->rows);
    /* The column before the middle one: a row begins with an empty texel. */
    const Int first_column = to_int(middle_column), rows = splat_int((int)params->height);
    for (int j = 0; j < 3; ++j) {
        const Int wrapped = to_int(middle_row) + (j - 1);
        const Int below = wrapped < 0 ? wrapped + rows : wrapped;
        const Int kept = below >= rows ? below - rows : below;
        put_uint_lanes(taps->first[j], int_to_uint(kept * (int)params->pitch + first_column));
    }
    return across * down;
}

/* Without the texels that hold no sample, whose alpha is 0: the sum is yet to be divided. */
static inline float4 read_taps(global const float4* buffer, const Taps* taps, uint lane) {
    float4 sum = (float4)(0.0f);
    for (int j = 0; j < 3; ++j) {
        global const float4* texels = buffer + taps->first[j][lane];
        float4 part = taps->columns[0][lane] * texels[0];
        part = fma((float4)(taps->columns[1][lane]), texels[1], part);
        part = fma((float4)(taps->columns[2][lane]), texels[2], part);
        sum = fma((float4)(taps->rows[j][lane]), part, sum);
    }
    return sum;
}

/* One work-item for MACULA_LANES slots: 4 x 4 pixels, or one. Within the disk the image holds its
 * samples, which pass into the buffer's colours towards the edge. Alpha: 1 where a sample lies in
 * a pixel's middle. */
kernel void remap_log_polar(global const FrameParams* restrict frame,
                            global const LogPolarParams* restrict params,
                            global const Fovea* restrict fovea,
                            global const float4* restrict buffer, global float4* restrict image) {
    const uint first = first_of_item(), width = frame->width, height = frame->height;
    uint x0, y0;
    pixel_of_slot(first / MACULA_RAY_BLOCK * MACULA_RAY_BLOCK, width, &x0, &y0);
    if (x0 >= width || y0 >= height)
        return;
    const Uint slot = lanes_from(first);
    const Uint across = x0 + (slot & 3u), down = y0 + (slot >> 2 & 3u);
    const Mask inside = (across < width) & (down < height);
    const Real x = uint_to_real(across) + (0.5f - fovea->x);
    const Real y = uint_to_real(down) + (0.5f - fovea->y);
    /* Lanes outside of the image and within the disk read the buffer in vain: where it begins. */
    const Real distance = m_sqrt(fma(x, x, y * y));
    const Mask wanted = inside & (distance > fovea->inner);
    if (!any_lane(wanted))
        return;
    const Real kept = m_max(distance, splat(fovea->inner));
    Taps taps;
    /* The samples lie in the buffer where the frame's jitter put them. */
    const Real column = log_polar_column(params, fovea, kept) - frame->jitter[0];
    Real near = put_taps(clamped(column, splat(0.0f), splat((float)params->width)),
                         log_polar_row(params, x, y) - frame->jitter[1], params, &taps);
    float4 sums[MACULA_LANES];
    for (uint lane = 0u; lane < MACULA_LANES; ++lane)
        sums[lane] = read_taps(buffer, &taps, lane);
    const Lane4 sum = lanes_of(sums);
    const Real scale = m_divide(splat(1.0f), m_max(sum.w, splat(LEAST_SUM)));
    Real3 colour = scale3(sum.xyz, scale);
    const Real disk = part_of_disk(fovea, distance);
    const Uint pixel = inside ? down * width + across : splat_uint(0u);
    if (any_lane(wanted & (disk > 0.0f))) {
        const Real3 sampled = gather4(image, pixel).xyz;
        const Real3 mixed = scale_add3(sub3(sampled, colour), disk, colour);
        colour = select3(disk > 0.0f, mixed, colour);
        near = fma(splat(1.0f) - near, disk, near);
    }
    scatter4(image, pixel, wanted, colour, near);
}
