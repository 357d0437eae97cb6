/* Rays of log-polar foveation (Mrad 2022, section 4.2) and log-rectilinear foveation (Li et al.
 * 2021): the pixels of the foveal disk and the texels of the buffer around it, in one list. Both
 * are chosen by packets of 4 x 4 in the order of lib/camera.h, the disk's first, so that neighbours
 * in the list lie close together. */
#include "lib/camera_ray.h"
#include "lib/log_polar.h"
#include "lib/random.h"

/* Cosine of the angle at which the gaze is taken to leave the image for good. */
#define LEAST_FORWARD 0.05f
/* How far outside of the image the gaze may lie, part of the diagonal: from further away a few
 * texels would stand for all of it, and their samples lie outside. */
#define MOST_OUTSIDE 0.25f

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
    global const Camera* camera = &frame->camera;
    const float per_x = m_divide(width, camera->tan_right + camera->tan_left);
    const float per_y = m_divide(height, camera->tan_up + camera->tan_down);
    const float diagonal = distance_of(width, height);
    const float out_x = m_divide(MOST_OUTSIDE * diagonal, per_x);
    const float out_y = m_divide(MOST_OUTSIDE * diagonal, per_y);
    const float right = clamped(m_divide(dot3(gaze, vector_at(camera->right)), forward),
                                -camera->tan_left - out_x, camera->tan_right + out_x);
    const float up = clamped(m_divide(dot3(gaze, vector_at(camera->up)), forward),
                             -camera->tan_down - out_y, camera->tan_up + out_y);
    const float x = (right + camera->tan_left) * per_x;
    const float y = (camera->tan_up - up) * per_y;
    const float corner_x = m_max(x, width - x), corner_y = m_max(y, height - y);
    const float far = distance_of(corner_x, corner_y);

    /* On the image a small angle grows with the square of the secant. */
    const float secant = fma(right, right, fma(up, up, 1.0f));
    const float by_angle = params->disk_tangent * m_sqrt(per_x * per_y) * secant;
    const float by_size = params->disk * 0.5f * diagonal;
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

/* One work-item a column or row, the columns first. axes: place_across() of the columns, then
 * place_down() of the rows, at the middles of the texels or, for a frame's rays, where the sample
 * of the regular grid lies in them. Rows of the buffer begin and end with an empty texel. */
kernel void tabulate_texels(global const FrameParams* restrict frame,
                            global const LogPolarParams* restrict params,
                            global const Fovea* restrict fovea, uint sample, uint of_rays,
                            global float4* restrict axes, global float4* restrict buffer) {
    const uint item = (uint)get_global_id(0), columns = params->width;
    if (item >= columns + params->height)
        return;
    const Texels texels = make_texels(frame, params, fovea);
    float dx = 0.5f, dy = 0.5f;
    if (of_rays != 0u)
        sample_offset(frame, 0u, sample, frame->sample_grid, &dx, &dy);
    if (item < columns) {
        if (item >= first_needed(&texels))
            axes[item] = place_across(&texels, (float)item + dx);
        return;
    }
    const uint row = item - columns;
    axes[item] = place_down(&texels, (float)row + dy);
    if (of_rays == 0u)
        buffer[row * params->pitch] = buffer[row * params->pitch + columns + 1u] = (float4)(0.0f);
}

/* Bit n: texel n of a packet of the buffer is sampled. Those that are read but not sampled are
 * emptied. */
static inline uint choose_texels(global const FrameParams* frame,
                                 global const LogPolarParams* params, global const Fovea* fovea,
                                 uint packet, global const float4* axes, global float4* buffer) {
    const uint columns = params->width, rows = params->height;
    const Texels all = make_texels(frame, params, fovea);
    const uint needed = first_needed(&all);
    uint column0, row0, bits = 0u;
    pixel_of_slot(packet * MACULA_RAY_BLOCK, columns, &column0, &row0);
    if (column0 + 4u <= needed || column0 >= columns || fovea->first_column >= columns)
        return 0u;
    for (uint lane = 0u; lane < MACULA_RAY_BLOCK; ++lane) {
        const uint column = column0 + (lane & 3u), row = row0 + (lane >> 2);
        if (column >= columns || column < needed || row >= rows)
            continue;
        const float4 across = axes[column], down = axes[columns + row];
        if (is_read(&all, across, down) && reaches_image(&all, across, down))
            bits |= 1u << lane;
        else
            buffer[row * params->pitch + column + 1u] = (float4)(0.0f);
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
                           global const float4* restrict axes, global uint* restrict masks,
                           global uint* restrict counts, global float4* restrict buffer) {
    const uint packet = (uint)get_global_id(0);
    const uint bits = packet < disk_packets
                          ? choose_disk(frame, fovea, packet)
                          : choose_texels(frame, params, fovea, packet - disk_packets, axes,
                                          buffer);
    masks[packet] = bits;
    counts[packet] = popcount(bits);
}

/* Where the samples go. */
typedef struct List {
    global RayBlock* rays;
    global uint* places;
    global float* spreads;
} List;

/* Where a ray goes through the image, and how wide its cone is there in pixels. */
typedef struct Aim {
    float x, y, spread;
} Aim;

static inline void add_ray(const List* list, global const FrameParams* frame, uint slot, uint place,
                           Aim aim) {
    const float3 direction =
        camera_direction(&frame->camera, frame->width, frame->height, aim.x, aim.y);
    store_camera_ray(frame, list->rays, slot, direction, MACULA_BACKGROUND_DEPTH);
    list->places[slot] = place;
    list->spreads[slot] = aim.spread;
}

static inline Aim aim_of_pixel(global const LogPolarParams* params, float x, float y) {
    const Aim aim = {
        x, y,
        params->thesis_lod ? log_polar_thesis_spread(params, 0.0f) * params->spread_scale : 1.0f};
    return aim;
}

static inline Aim aim_of_texel(const Texels* t, global const LogPolarParams* params, float4 across,
                               float4 down) {
    const Sample s = sample_at(t, across, down);
    /* The side of a square of the texel's area. */
    const float spread = params->thesis_lod
                             ? log_polar_thesis_spread(params, lod_column(t, across, down))
                             : m_max(m_sqrt(s.texel.along * s.texel.around), 1.0f);
    const Aim aim = {s.x, s.y, spread * params->spread_scale};
    return aim;
}

static inline void end_list(const List* list, global const LogPolarParams* params, uint sum,
                            global uint* ray_count, global ulong* ray_total) {
    const uint total = min(sum, params->capacity);
    pad_list(list->rays, list->places, total);
    for (uint slot = total; slot % MACULA_RAY_BLOCK != 0u; ++slot)
        list->spreads[slot] = 1.0f;
    *ray_count = (total + MACULA_RAY_BLOCK - 1u) / MACULA_RAY_BLOCK * MACULA_RAY_BLOCK;
    *ray_total += total;
}

/* One work-item a packet. axes: of this sample, by tabulate_texels(). places: the pixel's index for
 * the disk, beyond them the texel's. A grid of samples is one in the buffer, hence warped in the
 * image (section 4.1.3). Texels for which the list has no room are emptied. */
kernel void generate_log_polar_rays(global const FrameParams* restrict frame,
                                    global const LogPolarParams* restrict params,
                                    global const Fovea* restrict fovea, uint disk_packets,
                                    uint sample, global const float4* restrict axes,
                                    global const uint* restrict masks,
                                    global const uint* restrict offsets,
                                    global const uint* restrict sum, global RayBlock* restrict rays,
                                    global uint* restrict places, global float* restrict spreads,
                                    global uint* restrict ray_count,
                                    global ulong* restrict ray_totals, uint ray_class,
                                    global float4* restrict buffer) {
    const uint packet = (uint)get_global_id(0);
    const List list = {rays, places, spreads};
    if (packet == 0u)
        end_list(&list, params, *sum, ray_count, ray_totals + ray_class);
    uint bits = masks[packet];
    if (bits == 0u)
        return;
    const uint pixels = frame->width * frame->height;
    const bool disk = packet < disk_packets;
    const uint columns = disk ? frame->width : params->width;
    const Texels texels = make_texels(frame, params, fovea);
    uint x0, y0, slot = offsets[packet];
    pixel_of_slot((disk ? packet : packet - disk_packets) * MACULA_RAY_BLOCK, columns, &x0, &y0);
    for (; bits != 0u; bits &= bits - 1u, ++slot) {
        const uint lane = popcount((bits & -bits) - 1u);
        const uint column = x0 + (lane & 3u), row = y0 + (lane >> 2);
        const uint texel = row * params->pitch + column + 1u;
        const uint place = disk ? row * columns + column : pixels + texel;
        if (slot >= params->capacity) {
            if (!disk)
                buffer[texel] = (float4)(0.0f);
            continue;
        }
        float dx, dy;
        sample_offset(frame, random_key(place, frame->frame, frame->seed), sample,
                      frame->sample_grid, &dx, &dy);
        const float x = (float)column + dx, y = (float)row + dy;
        const bool known = frame->sample_grid > 0u;
        Aim aim;
        if (disk)
            aim = aim_of_pixel(params, x, y);
        else
            aim = aim_of_texel(&texels, params, known ? axes[column] : place_across(&texels, x),
                               known ? axes[columns + row] : place_down(&texels, y));
        add_ray(&list, frame, slot, place, aim);
    }
}
