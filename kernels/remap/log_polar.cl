/* From the samples of kernel log-polar foveation to the image (Mrad 2022, sections 4.2.2, 4.2.3).
 */
#include "lib/camera.h"
#include "lib/lane_array.h"
#include "lib/lane_memory.h"
#include "lib/log_polar.h"
#include "shared/ray.h"

/* One work-item a slot: samples of the disk go to their pixels, the others to the buffer. */
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
        buffer[place - pixels] = colour;
}

/* A quadratic B-spline's weights for a place f in [-0.5, 0.5] from the middle one of three samples:
 * a Gaussian of half a sample but for its tails. */
static inline void spline_weights(Real f, Real weights[3]) {
    const Real before = 0.5f - f, after = 0.5f + f;
    weights[0] = 0.5f * (before * before);
    weights[1] = fma(f, -f, splat(0.75f));
    weights[2] = 0.5f * (after * after);
}

/* What a lane reads. */
typedef struct Place {
    int column, row;
    float columns[3], rows[3]; /* weights */
} Place;

/* The buffer there, without the texels that lie outside of the image. */
static inline float4 read_buffer(global const float4* buffer, global const LogPolarParams* params,
                                 int first_column, const Place* at) {
    const int last = (int)params->width - 1, height = (int)params->height;
    float4 sum = (float4)(0.0f);
    for (int j = 0; j < 3; ++j) {
        const int wrapped = at->row + j - 1;
        const int below = wrapped < 0 ? wrapped + height : wrapped;
        const int row = below >= height ? below - height : below;
        global const float4* line = buffer + (uint)row * params->width;
        float4 part = (float4)(0.0f);
        for (int i = 0; i < 3; ++i)
            part = fma((float4)(at->columns[i]),
                       line[clamp(at->column + i - 1, first_column, last)], part);
        sum = fma((float4)(at->rows[j]), part, sum);
    }
    return (float4)(sum.xyz * m_divide(1.0f, m_max(sum.w, 1e-6f)), 1.0f);
}

/* The weights and the middle sample along one axis of the buffer, lane by lane. */
typedef struct Axis {
    float weights[3][MACULA_LANES];
    float middle[MACULA_LANES];
} Axis;

static inline void put_axis(Real place, Axis* axis) {
    const Real middle = rint(place);
    Real weights[3];
    spline_weights(place - middle, weights);
    for (int i = 0; i < 3; ++i)
        put_lanes(axis->weights[i], weights[i]);
    put_lanes(axis->middle, middle);
}

/* One work-item for MACULA_LANES slots: 4 x 4 pixels, or one. Within the disk the image holds its
 * samples, which pass into the buffer's colours towards the edge. */
kernel void remap_log_polar(global const FrameParams* restrict frame,
                            global const LogPolarParams* restrict params,
                            global const Fovea* restrict fovea,
                            global const float4* restrict buffer, global float4* restrict image) {
    const uint first = first_of_item();
    uint x0, y0;
    pixel_of_slot(first / MACULA_RAY_BLOCK * MACULA_RAY_BLOCK, frame->width, &x0, &y0);
    const Uint slot = lanes_from(first);
    const Real x = uint_to_real(x0 + (slot & 3u)) + (0.5f - fovea->x);
    const Real y = uint_to_real(y0 + (slot >> 2 & 3u)) + (0.5f - fovea->y);
    const Real distance = m_sqrt(fma(x, x, y * y));
    if (!any_lane(distance > splat(fovea->inner)))
        return;
    Axis columns, rows;
    put_axis(log_polar_column(params, fovea, distance) - 0.5f, &columns);
    put_axis(log_polar_row(params, x, y) - 0.5f, &rows);
    float distances[MACULA_LANES];
    put_lanes(distances, distance);
    const float fade = m_divide(1.0f, m_max(fovea->radius - fovea->inner, 1e-6f));
    for (uint lane = 0u; lane < MACULA_LANES; ++lane) {
        const uint place = (first + lane) % MACULA_RAY_BLOCK;
        const uint column = x0 + (place & 3u), row = y0 + (place >> 2);
        const float r = distances[lane];
        if (column >= frame->width || row >= frame->height || r <= fovea->inner)
            continue;
        const Place at = {
            (int)columns.middle[lane],
            (int)rows.middle[lane],
            {columns.weights[0][lane], columns.weights[1][lane], columns.weights[2][lane]},
            {rows.weights[0][lane], rows.weights[1][lane], rows.weights[2][lane]}};
        const uint pixel = row * frame->width + column;
        float4 colour = read_buffer(buffer, params, (int)fovea->first_column, &at);
        if (r < fovea->radius) {
            const float t = (r - fovea->inner) * fade;
            const float part = t * t * fma(t, -2.0f, 3.0f);
            colour = fma(colour - image[pixel], (float4)(part), image[pixel]);
        }
        image[pixel] = colour;
    }
}
