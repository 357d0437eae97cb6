/* From the samples of log-rectilinear foveation to the image (Li et al. 2021): pixels beyond the
 * foveal disk are interpolated between two by two texels of the buffer. */
#include "lib/camera.h"
#include "lib/lane_array.h"
#include "lib/log_polar.h"
#include "lib/log_rect.h"
#include "remap/weights.h"
#include "shared/ray.h"

/* What the lanes read: two weights along an axis, and where. */
typedef struct Taps {
    float second_column[MACULA_LANES], second_row[MACULA_LANES];
    uint texel[4][MACULA_LANES]; /* row by row */
} Taps;

/* The first of the two texels between which a place lies, 0 being the buffer's first edge. */
static inline Real first_of_two(Real place, Real* second) {
    const Real first = floor(place - 0.5f);
    *second = (place - 0.5f) - first;
    return first;
}

/* A row of the buffer begins with an empty texel. Returns how near the nearest sample lies. */
static inline Real put_taps(Real column, Real row, global const LogPolarParams* params,
                            Taps* taps) {
    const Int last_column = splat_int((int)params->width - 1);
    const Int last_row = splat_int((int)params->height - 1), none = splat_int(0);
    Real across, down;
    const Int left = to_int(first_of_two(column, &across));
    const Int top = to_int(first_of_two(row, &down));
    put_lanes(taps->second_column, across);
    put_lanes(taps->second_row, down);
    for (int k = 0; k < 4; ++k) {
        const Int x = left + (k & 1), y = top + (k >> 1);
        const Int in_x = x < none ? none : (x > last_column ? last_column : x);
        const Int in_y = y < none ? none : (y > last_row ? last_row : y);
        put_uint_lanes(taps->texel[k], int_to_uint(in_y * (int)params->pitch + in_x + 1));
    }
    return nearness(across - rint(across)) * nearness(down - rint(down));
}

/* Without the texels that hold no sample, whose alpha is 0: the sum is yet to be divided. */
static inline float4 read_taps(global const float4* buffer, const Taps* taps, uint lane) {
    const float right = taps->second_column[lane], below = taps->second_row[lane];
    const float4 above = fma((float4)(right), buffer[taps->texel[1][lane]],
                             (1.0f - right) * buffer[taps->texel[0][lane]]);
    const float4 under = fma((float4)(right), buffer[taps->texel[3][lane]],
                             (1.0f - right) * buffer[taps->texel[2][lane]]);
    return fma((float4)(below), under, (1.0f - below) * above);
}

/* One work-item for MACULA_LANES slots: 4 x 4 pixels, or one. Within the disk the image holds its
 * samples, which pass into the buffer's colours towards the edge. Alpha: 1 where a sample lies in
 * a pixel's middle. */
kernel void remap_log_rect(global const FrameParams* restrict frame,
                           global const LogPolarParams* restrict params,
                           global const Fovea* restrict fovea, global const float4* restrict buffer,
                           global float4* restrict image) {
    const uint first = first_of_item(), width = frame->width, height = frame->height;
    uint x0, y0;
    pixel_of_slot(first / MACULA_RAY_BLOCK * MACULA_RAY_BLOCK, width, &x0, &y0);
    if (x0 >= width || y0 >= height)
        return;
    const Uint slot = lanes_from(first);
    const Uint across = x0 + (slot & 3u), down = y0 + (slot >> 2 & 3u);
    const Mask inside = (across < width) & (down < height);
    const Real x = uint_to_real(across) + 0.5f, y = uint_to_real(down) + 0.5f;
    const Real dx = x - fovea->x, dy = y - fovea->y;
    const Real distance = m_sqrt(fma(dx, dx, dy * dy));
    const Mask wanted = inside & (distance > fovea->inner);
    if (!any_lane(wanted))
        return;
    const RectAxis columns = make_rect_axis(fovea->x, width, params->width);
    const RectAxis rows = make_rect_axis(fovea->y, height, params->height);
    Taps taps;
    /* The samples lie in the buffer where the frame's jitter put them. */
    Real near = put_taps(rect_texel(&columns, params->inverse_alpha, x) - frame->jitter[0],
                         rect_texel(&rows, params->inverse_alpha, y) - frame->jitter[1], params,
                         &taps);
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
