/* Rays of log-polar foveation (Mrad 2022, section 4.2) and log-rectilinear foveation (Li et al.
 * 2021): the pixels of the foveal disk and the texels of the buffer around it, in one list. Both
 * are chosen by packets of 4 x 4 in the order of lib/camera.h, the disk's first, so that neighbours
 * in the list lie close together. */
#include "lib/camera_ray.h"
#include "lib/log_polar.h"
#include "lib/random.h"

/* Cosine of the angle at which the gaze is taken to leave the image for good. */
#define LEAST_FORWARD 0.05f

static inline float distance_of(float x, float y) {
    return m_sqrt(fma(x, x, y * y));
}

/* A point of the buffer in the image. */
typedef struct Sample {
    float x, y;
    TexelSize texel;
} Sample;

/* 1 for the log-rectilinear buffer. */
#if MACULA_RECTANGULAR
#include "generate/texels_rect.h"
#else
#include "generate/texels_polar.h"
#endif

/* One work-item. */
kernel void place_fovea(global const FrameParams* restrict frame,
                        global const LogPolarParams* restrict params,
                        global Fovea* restrict fovea) {
    const float width = (float)frame->width, height = (float)frame->height;
    const float3 gaze = vector_at(frame->gaze);
    const float forward = m_max(dot3(gaze, vector_at(frame->camera.forward)), LEAST_FORWARD);
    const float right = m_divide(dot3(gaze, vector_at(frame->camera.right)), forward);
    const float up = m_divide(dot3(gaze, vector_at(frame->camera.up)), forward);
    const float per_x = m_divide(width, frame->camera.tan_right + frame->camera.tan_left);
    const float per_y = m_divide(height, frame->camera.tan_up + frame->camera.tan_down);
    const float x = (right + frame->camera.tan_left) * per_x;
    const float y = (frame->camera.tan_up - up) * per_y;
    const float corner_x = m_max(x, width - x), corner_y = m_max(y, height - y);
    const float far = distance_of(corner_x, corner_y);

    /* On the image a small angle grows with the square of the secant. */
    const float secant = fma(right, right, fma(up, up, 1.0f));
    const float by_angle = params->disk_tangent * m_sqrt(per_x * per_y) * secant;
    const float by_size = params->disk * 0.5f * distance_of(width, height);
    const float wanted = (params->disk_tangent > 0.0f ? by_angle : by_size) * frame->gaze_widening;
    const float radius = fitting_radius(frame, params, x, y, wanted);
    fovea->x = x;
    fovea->y = y;
    fovea->log_far = m_log2(far + 1.0f);
    fovea->inverse_log_far = m_divide(1.0f, fovea->log_far);
    fovea->radius = radius;
    fovea->inner = radius >= far ? far + 1.0f : radius * (1.0f - params->fade);
    fovea->pad = 0u;
    /* What surrounds the disk is read between three columns; jitter shifts them by up to a half. */
    const bool jittered = frame->jitter[0] != 0.0f || frame->jitter[1] != 0.0f;
    const float first = log_polar_column(params, fovea, fovea->inner) - (jittered ? 3.0f : 2.0f);
    const uint needed = MACULA_RECTANGULAR || first < 0.0f ? 0u : (uint)first;
    fovea->first_column = radius >= far ? params->width : needed;
}

static inline bool in_disk(global const FrameParams* frame, global const Fovea* fovea, uint x,
                           uint y) {
    const float dx = (float)x + 0.5f - fovea->x, dy = (float)y + 0.5f - fovea->y;
    return x < frame->width && y < frame->height && distance_of(dx, dy) < fovea->radius;
}

/* Bit n: texel n of a packet of the buffer is sampled. The buffer begins empty. */
static inline uint choose_texels(global const FrameParams* frame,
                                 global const LogPolarParams* params, global const Fovea* fovea,
                                 uint packet, global float4* buffer) {
    const uint width = params->width;
    const Texels all = make_texels(frame, params, fovea);
    uint column0, row0, bits = 0u;
    pixel_of_slot(packet * MACULA_RAY_BLOCK, width, &column0, &row0);
    for (uint lane = 0u; lane < MACULA_RAY_BLOCK; ++lane) {
        const uint column = column0 + (lane & 3u), row = row0 + (lane >> 2);
        if (column >= width || row >= params->height)
            continue;
        global float4* texels = buffer + row * params->pitch;
        if (column == 0u)
            texels[0] = texels[width + 1u] = (float4)(0.0f);
        const bool needed = is_read(&all, column, row);
        if (needed || MACULA_RECTANGULAR)
            texels[column + 1u] = (float4)(0.0f);
        bits |= needed && reaches_image(&all, column, row) ? 1u << lane : 0u;
    }
    return bits;
}

static inline uint choose_disk(global const FrameParams* frame, global const Fovea* fovea,
                               uint packet) {
    uint x0, y0, bits = 0u;
    pixel_of_slot(packet * MACULA_RAY_BLOCK, frame->width, &x0, &y0);
    const float dx = (float)x0 + 2.0f - fovea->x, dy = (float)y0 + 2.0f - fovea->y;
    if (distance_of(dx, dy) > fovea->radius + 4.0f)
        return 0u;
    for (uint lane = 0u; lane < MACULA_RAY_BLOCK; ++lane)
        bits |= in_disk(frame, fovea, x0 + (lane & 3u), y0 + (lane >> 2)) ? 1u << lane : 0u;
    return bits;
}

/* One work-item a packet: the first `disk_packets` are the image's, the others the buffer's. */
kernel void choose_samples(global const FrameParams* restrict frame,
                           global const LogPolarParams* restrict params,
                           global const Fovea* restrict fovea, uint disk_packets,
                           global uint* restrict masks, global uint* restrict counts,
                           global float4* restrict buffer) {
    const uint packet = (uint)get_global_id(0);
    const uint bits = packet < disk_packets
                          ? choose_disk(frame, fovea, packet)
                          : choose_texels(frame, params, fovea, packet - disk_packets, buffer);
    masks[packet] = bits;
    counts[packet] = popcount(bits);
}

/* Where the samples go. */
typedef struct List {
    global RayBlock* rays;
    global uint* places;
    global float* spreads;
} List;

static inline void add_ray(const List* list, global const FrameParams* frame, uint slot, uint place,
                           float x, float y, float spread) {
    const float3 direction = camera_direction(&frame->camera, frame->width, frame->height, x, y);
    store_camera_ray(frame, list->rays, slot, direction, MACULA_BACKGROUND_DEPTH);
    list->places[slot] = place;
    list->spreads[slot] = spread;
}

/* One work-item a packet. places: the pixel's index for the disk, beyond them the texel's. A grid
 * of samples is one in the buffer, hence warped in the image (section 4.1.3). */
kernel void generate_log_polar_rays(global const FrameParams* restrict frame,
                                    global const LogPolarParams* restrict params,
                                    global const Fovea* restrict fovea, uint disk_packets,
                                    uint sample, global const uint* restrict masks,
                                    global const uint* restrict offsets,
                                    global const uint* restrict sum, global RayBlock* restrict rays,
                                    global uint* restrict places, global float* restrict spreads,
                                    global uint* restrict ray_count,
                                    global ulong* restrict ray_totals, uint ray_class) {
    const uint packet = (uint)get_global_id(0);
    const uint pixels = frame->width * frame->height;
    const List list = {rays, places, spreads};
    const Texels texels = make_texels(frame, params, fovea);
    if (packet == 0u) {
        const uint total = min(*sum, params->capacity);
        pad_list(rays, places, total);
        for (uint slot = total; slot % MACULA_RAY_BLOCK != 0u; ++slot)
            spreads[slot] = 1.0f;
        *ray_count = (total + MACULA_RAY_BLOCK - 1u) / MACULA_RAY_BLOCK * MACULA_RAY_BLOCK;
        ray_totals[ray_class] += total;
    }
    const bool disk = packet < disk_packets;
    const uint across = disk ? frame->width : params->width;
    uint x0, y0, slot = offsets[packet];
    pixel_of_slot((disk ? packet : packet - disk_packets) * MACULA_RAY_BLOCK, across, &x0, &y0);
    for (uint bits = masks[packet]; bits != 0u && slot < params->capacity;
         bits &= bits - 1u, ++slot) {
        const uint lane = popcount((bits & -bits) - 1u);
        const uint column = x0 + (lane & 3u), row = y0 + (lane >> 2);
        const uint place =
            disk ? row * across + column : pixels + row * params->pitch + column + 1u;
        float dx, dy, x, y, spread = 1.0f, bias_column = 0.0f;
        sample_offset(frame, random_key(place, frame->frame, frame->seed), sample,
                      frame->sample_grid, &dx, &dy);
        x = (float)column + dx;
        y = (float)row + dy;
        if (!disk) {
            bias_column = lod_column(&texels, x, y);
            const Sample s = sample_at(&texels, x, y);
            x = s.x;
            y = s.y;
            /* The side of a square of the texel's area. */
            spread = m_max(m_sqrt(s.texel.along * s.texel.around), 1.0f) * params->spread_scale;
        }
        if (params->thesis_lod != 0u)
            spread = log_polar_thesis_spread(params, bias_column) * params->spread_scale;
        add_ray(&list, frame, slot, place, x, y, spread);
    }
}
