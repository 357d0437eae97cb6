/* Rays where the eye, the support grid or the resampling info asks for them (Weier et al. 2016,
 * section 3.1). Pixels are chosen sixteen at a time, a 4 x 4 packet of lib/camera.h; the chosen
 * ones keep that order, so that sixteen neighbours in the list are still close together. */
#include "lib/acuity.h"
#include "lib/camera_ray.h"
#include "lib/random_vector.h"
#include "lib/simd.h"
#include "shared/ray.h"
#include "shared/surface.h"
#include "shared/weier.h"

/* Bit n is set where lane n is not 0. */
static inline uint bits_of(int16 mask) {
    const int16 bit =
        mask & (int16)(1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768);
    const int8 a = bit.lo | bit.hi;
    const int4 b = a.lo | a.hi;
    const int2 c = b.lo | b.hi;
    return (uint)(c.x | c.y);
}

static inline uint16 four_rows(uint4 columns) {
    return (uint16)(columns, columns, columns, columns);
}

static inline uint16 four_columns(uint4 rows) {
    return (uint16)(rows.xxxx, rows.yyyy, rows.zzzz, rows.wwww);
}

/* What decides about the pixels of one packet. */
typedef struct Choice {
    int16 fovea;  /* within r0: sampled, and the sample is taken as it is */
    int16 chosen; /* by the foveal function, fovea included */
} Choice;

static inline Choice choose_by_gaze(global const FrameParams* frame,
                                    global const WeierParams* weier, uint x0, uint y0) {
    const uint width = frame->width, height = frame->height;
    const uint16 x = x0 + four_rows((uint4)(0, 1, 2, 3));
    const uint16 y = y0 + four_columns((uint4)(0, 1, 2, 3));
    const float3 gaze = vector_at(frame->gaze);
    const float right = dot3(gaze, vector_at(frame->camera.right));
    const float up = dot3(gaze, vector_at(frame->camera.up));
    const float forward = dot3(gaze, vector_at(frame->camera.forward));
    const float step_x = m_divide(frame->camera.tan_right + frame->camera.tan_left, (float)width);
    const float step_y = m_divide(frame->camera.tan_up + frame->camera.tan_down, (float)height);
    const float16 sx =
        fma(convert_float16(x) + 0.5f, (float16)(step_x), (float16)(-frame->camera.tan_left));
    const float16 sy =
        fma(convert_float16(y) + 0.5f, (float16)(-step_y), (float16)(frame->camera.tan_up));
    const float16 length_squared = fma(sx, sx, fma(sy, sy, (float16)(1.0f)));
    const float16 along = fma((float16)(right), sx, fma((float16)(up), sy, (float16)(forward)));
    const float16 cosine = along * m_inverse_sqrt(length_squared);
    const float r0 = weier->r0 * frame->gaze_widening, r1 = weier->r1 * frame->gaze_widening;
    const float16 xi = random_unit(random_key(y * width + x, frame->frame, frame->seed),
                                   (uint16)(0u), MACULA_DIMENSION_FOVEA);

    Choice choice;
    choice.fovea = cosine >= cosine_of_eccentricity(r0);
    const int16 outside = cosine <= cosine_of_eccentricity(r1);
    float16 probability = weier->p_min;
    if (any_lane16(~(choice.fovea | outside))) {
        float cosines[16], probabilities[16];
        vstore16(cosine, 0, cosines);
        for (uint lane = 0u; lane < 16u; ++lane)
            probabilities[lane] =
                foveal_probability(eccentricity_of_cosine(cosines[lane]), r0, r1, weier->p_min);
        probability = vload16(0, probabilities);
    }
    choice.chosen = choice.fovea | (xi < probability);
    return choice;
}

/* Lanes that belong to the support image. The tables hold the support column of a pixel column, or
 * MACULA_NO_CELL; likewise rows. They are as long as the tiles reach. */
static inline int16 on_support_grid(global const uint* columns, global const uint* rows, uint x0,
                                    uint y0) {
    const uint4 column = vload4(0, columns + x0), row = vload4(0, rows + y0);
    return (four_rows(column) != MACULA_NO_CELL) & (four_columns(row) != MACULA_NO_CELL);
}

/* Lanes that the resampling info wants, and all of them where there is no history to show: a first
 * frame, or the one after a cut. `keys`: of reproject/mesh.cl. */
static inline int16 to_resample(global const uint* keys, global const uint* history,
                                global const WeierParams* weier, uint x0, uint y0) {
    if (*history == 0u)
        return (int16)(weier->first_frame_full != 0u ? -1 : 0);
    const global uint* first = keys + y0 * weier->pitch + x0;
    const uint16 key =
        (uint16)(vload4(0, first), vload4(0, first + weier->pitch),
                 vload4(0, first + 2u * weier->pitch), vload4(0, first + 3u * weier->pitch));
    const int16 marked = (key & 1u) != 0u; /* MACULA_NO_KEY, too */
    return marked & ((key != MACULA_NO_KEY) | (int16)(weier->resample_new != 0u ? -1 : 0));
}

/* One work-item a packet. masks: bit n of the lower half: lane n is sampled; of the upper half: the
 * sample is taken as it is (fovea or resampled), not blended with the cache. */
kernel void choose_pixels(global const FrameParams* restrict frame,
                          global const WeierParams* restrict weier,
                          global const uint* restrict columns, global const uint* restrict rows,
                          global const uint* restrict keys, global const uint* restrict history,
                          global uint* restrict masks, global uint* restrict counts) {
    const uint packet = (uint)get_global_id(0);
    const uint width = frame->width, height = frame->height;
    uint x0, y0;
    pixel_of_slot(packet * MACULA_RAY_BLOCK, width, &x0, &y0);
    const int16 inside = (x0 + four_rows((uint4)(0, 1, 2, 3)) < width) &
                         (y0 + four_columns((uint4)(0, 1, 2, 3)) < height);
    const Choice choice = choose_by_gaze(frame, weier, x0, y0);
    const int16 resampled = to_resample(keys, history, weier, x0, y0);
    const int16 fresh = (choice.fovea | resampled) & inside;
    const int16 sampled =
        (choice.chosen | resampled | on_support_grid(columns, rows, x0, y0)) & inside;
    const uint bits = bits_of(sampled);
    masks[packet] = bits | bits_of(fresh) << 16;
    counts[packet] = popcount(bits);
}

static inline void write_ray(global const FrameParams* frame, global const WeierParams* weier,
                             uint sample, global RayBlock* rays, uint slot, uint x, uint y) {
    const uint width = frame->width, height = frame->height;
    const uint key = random_key(y * width + x, frame->frame, frame->seed);
    const uint grid = weier->jitter != 0u ? 0u : frame->sample_grid;
    float dx, dy;
    sample_offset(frame, key, sample, grid, &dx, &dy);
    const float3 direction =
        camera_direction(&frame->camera, width, height, (float)x + dx, (float)y + dy);
    store_camera_ray(frame, rays, slot, direction, MACULA_BACKGROUND_DEPTH);
}

/* One work-item a packet: its rays go to where the prefix sum of the counts puts them. */
kernel void generate_listed_rays(global const FrameParams* restrict frame,
                                 global const WeierParams* restrict weier, uint sample,
                                 global const uint* restrict masks,
                                 global const uint* restrict offsets,
                                 global const uint* restrict total, global RayBlock* restrict rays,
                                 global uint* restrict pixels, global uint* restrict ray_count,
                                 global ulong* restrict ray_totals, uint ray_class) {
    const uint packet = (uint)get_global_id(0);
    if (packet == 0u) {
        pad_list(rays, pixels, *total);
        *ray_count = (*total + MACULA_RAY_BLOCK - 1u) / MACULA_RAY_BLOCK * MACULA_RAY_BLOCK;
        ray_totals[ray_class] += *total;
    }
    uint x0, y0, slot = offsets[packet];
    pixel_of_slot(packet * MACULA_RAY_BLOCK, frame->width, &x0, &y0);
    for (uint bits = masks[packet] & 0xffffu; bits != 0u; bits &= bits - 1u) {
        const uint lane = popcount((bits & -bits) - 1u);
        const uint x = x0 + (lane & 3u), y = y0 + (lane >> 2);
        pixels[slot] = y * frame->width + x;
        write_ray(frame, weier, sample, rays, slot, x, y);
        ++slot;
    }
}
