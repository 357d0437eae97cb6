/* Refresh rate modulation (Smith et al. 2014): the rays of the pixels that a frame refreshes, in
 * the order of the plan (shared/rrm.h). A pixel of a packet that is not refreshed leaves its slot
 * inactive. A block is four pixels: MACULA_BLOCK_WIDTH (2 or 4) along the rows. */
#include "lib/camera.h"
#include "lib/lane_memory.h"
#include "shared/ray.h"
#include "shared/rrm.h"
#include "shared/surface.h"

/* Groups of a packet. */
#define GROUPS_ACROSS (4u / MACULA_BLOCK_WIDTH)
#define GROUPS_DOWN MACULA_BLOCK_WIDTH
#define BLOCK_HEIGHT (4u / MACULA_BLOCK_WIDTH)

/* The pixels of a work-item's slots, and which of them are refreshed. */
typedef struct Pixels {
    Uint x, y;
    Mask refreshed;
} Pixels;

/* Where the packet `index` of a region lies. */
MACULA_ALWAYS_INLINE void place_packet(global const RefreshRegion* region, uint index, uint* column,
                                       uint* row) {
    const uint of_strip = MACULA_REFRESH_STRIP * region->columns;
    const uint strip = index / of_strip, rest = index % of_strip;
    const uint above = strip * MACULA_REFRESH_STRIP;
    const uint left = region->rows - above;
    const uint height = left < MACULA_REFRESH_STRIP ? left : MACULA_REFRESH_STRIP;
    const uint across = rest / height;
    *column = across;
    *row = above + rest % height;
}

MACULA_ALWAYS_INLINE Pixels foveal_pixels(global const RefreshPlan* plan,
                                          global const RefreshRegion* region, uint index,
                                          Uint lane) {
    uint column, row;
    place_packet(region, index, &column, &row);
    Pixels p;
    p.x = region->column + 4u * column + (lane & 3u);
    p.y = region->row + 4u * row + (lane >> 2);
    p.refreshed = (p.x < plan->x1) & (p.y < plan->y1);
    return p;
}

MACULA_ALWAYS_INLINE Pixels peripheral_pixels(global const RefreshPlan* plan,
                                              global const RefreshRegion* region,
                                              global const uint* orders, uint index, Uint lane) {
    const uint passes = plan->group_blocks / region->period;
    const uint place = index / passes;
    uint column, row;
    place_packet(region, place, &column, &row);
    const Uint block = lane >> 2, pixel = lane & 3u, pixel_row = pixel / MACULA_BLOCK_WIDTH;
    const Uint group_x = (region->column + column) * GROUPS_ACROSS + block % GROUPS_ACROSS;
    const Uint group_y = (region->row + row) * GROUPS_DOWN + block / GROUPS_ACROSS;
    const uint turn = plan->turn % region->period + index % passes * region->period;
    const Uint order = (group_y % MACULA_REFRESH_ORDERS) * MACULA_REFRESH_ORDERS +
                       group_x % MACULA_REFRESH_ORDERS;
    const Uint due = order * plan->group_blocks + turn;
    const Uint offset = MACULA_GATHER(uint, orders, due, );
    Pixels p;
    p.x = (group_x * plan->group_width + (offset & 0xffffu)) * MACULA_BLOCK_WIDTH +
          pixel % MACULA_BLOCK_WIDTH;
    p.y = (group_y * plan->group_height + (offset >> 16)) * BLOCK_HEIGHT + pixel_row;
    p.refreshed = (p.x < plan->x0) | (p.x >= plan->x1) | (p.y < plan->y0) | (p.y >= plan->y1);
    return p;
}

MACULA_ALWAYS_INLINE Pixels listed_pixels(global const FrameParams* frame,
                                          global const RefreshPlan* plan, global const uint* orders,
                                          uint packet, Uint lane) {
    global const RefreshRegion* region = plan->region;
    for (uint i = 1u; i < plan->regions && packet >= plan->region[i].first; ++i)
        ++region;
    const uint index = packet - region->first;
    Pixels p = region->period == 0u ? foveal_pixels(plan, region, index, lane)
                                    : peripheral_pixels(plan, region, orders, index, lane);
    p.refreshed = p.refreshed & (p.x < frame->width) & (p.y < frame->height);
    return p;
}

/* camera_direction() of lib/camera.h in lanes. */
MACULA_ALWAYS_INLINE Real3 direction_through(global const FrameParams* frame, Real x, Real y) {
    global const Camera* c = &frame->camera;
    const float step_x = m_divide(c->tan_right + c->tan_left, (float)frame->width);
    const float step_y = m_divide(c->tan_up + c->tan_down, (float)frame->height);
    const Real sx = fma(x, splat(step_x), splat(-c->tan_left));
    const Real sy = fma(y, splat(-step_y), splat(c->tan_up));
    return scale_add3(splat_vector(vector_at(c->right)), sx,
                      scale_add3(splat_vector(vector_at(c->up)), sy,
                                 splat_vector(vector_at(c->forward))));
}

/* subpixel_offset() of lib/camera.h in lanes. */
MACULA_ALWAYS_INLINE void offset_in_pixel(Uint key, uint sample, uint grid, Real* x, Real* y) {
    if (grid > 0u) {
        float dx, dy;
        subpixel_offset(0u, sample, grid, &dx, &dy);
        *x = splat(dx);
        *y = splat(dy);
    } else {
        *x = random_unit(key, splat_uint(sample), MACULA_DIMENSION_PIXEL);
        *y = random_unit(key, splat_uint(sample), MACULA_DIMENSION_PIXEL + 1u);
    }
}

MACULA_ALWAYS_INLINE void store_ray(global const FrameParams* frame, global RayBlock* rays,
                                    uint slot, Real3 direction, Mask active) {
    global RayBlock* block = rays + slot / MACULA_RAY_BLOCK;
    const uint lane = slot % MACULA_RAY_BLOCK;
    store_reals(block->origin_x, lane, splat(frame->camera.origin[0]));
    store_reals(block->origin_y, lane, splat(frame->camera.origin[1]));
    store_reals(block->origin_z, lane, splat(frame->camera.origin[2]));
    store_reals(block->t_min, lane, splat(0.0f));
    store_reals(block->direction_x, lane, direction.x);
    store_reals(block->direction_y, lane, direction.y);
    store_reals(block->direction_z, lane, direction.z);
    store_reals(block->t_max, lane, active ? splat(MACULA_BACKGROUND_DEPTH) : splat(-1.0f));
}

/* One work-item as many slots as it has lanes. counts: the refreshed pixels of each. */
kernel void generate_refreshed_rays(global const FrameParams* restrict frame,
                                    global const RefreshPlan* restrict plan,
                                    global const uint* restrict orders, uint sample,
                                    global RayBlock* restrict rays, global uint* restrict pixels,
                                    global uint* restrict ray_count, global uint* restrict counts) {
    const uint first = first_of_item(), packet = first / MACULA_RAY_BLOCK;
    if (first == 0u)
        *ray_count = plan->packets * MACULA_RAY_BLOCK;
    if (packet >= plan->packets) {
        counts[get_global_id(0)] = 0u;
        return;
    }
    const Uint lane = lanes_from(first) % MACULA_RAY_BLOCK;
    const Pixels p = listed_pixels(frame, plan, orders, packet, lane);
    const Uint pixel = p.y * frame->width + p.x;
    Real dx, dy;
    offset_in_pixel(random_key(pixel, frame->frame, frame->seed), sample, frame->sample_grid, &dx,
                    &dy);
    const Real3 direction = direction_through(frame, uint_to_real(p.x) + (dx + frame->jitter[0]),
                                              uint_to_real(p.y) + (dy + frame->jitter[1]));
    store_ray(frame, rays, first, direction, p.refreshed);
    store_uints(pixels, first, p.refreshed ? pixel : splat_uint(MACULA_NO_PIXEL));
    counts[get_global_id(0)] = count_lanes(p.refreshed);
}

/* One work-group. partial: a word for each of its work-items. */
kernel void count_refreshed(global const uint* restrict counts, uint items, local uint* partial,
                            global ulong* restrict ray_totals, uint ray_class) {
    const uint me = (uint)get_local_id(0), group = (uint)get_local_size(0);
    uint sum = 0u;
    for (uint i = me; i < items; i += group)
        sum += counts[i];
    partial[me] = sum;
    barrier(CLK_LOCAL_MEM_FENCE);
    if (me == 0u) {
        uint all = 0u;
        for (uint k = 0u; k < group; ++k)
            all += partial[k];
        ray_totals[ray_class] += all;
    }
}
