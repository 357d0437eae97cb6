/* Which pixels the packets of a refresh plan (shared/rrm.h) hold. A block is four pixels:
 * MACULA_BLOCK_WIDTH (2 or 4) along the rows. OpenCL C only. */
#ifndef MACULA_REFRESH_PLACES_H
#define MACULA_REFRESH_PLACES_H

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
    Mask refreshed, foveal;
} Pixels;

MACULA_ALWAYS_INLINE Mask in_rectangle(global const RefreshPlan* plan, Uint x, Uint y) {
    return (x >= plan->x0) & (x < plan->x1) & (y >= plan->y0) & (y < plan->y1);
}

/* camera_direction() of lib/camera.h in lanes. */
MACULA_ALWAYS_INLINE Real3 direction_through(global const FrameParams* frame, Real x, Real y) {
    global const Camera* c = &frame->camera;
    const float step_x = m_divide(c->tan_right + c->tan_left, (float)frame->width);
    const float step_y = m_divide(c->tan_up + c->tan_down, (float)frame->height);
    const Real sx = fma(x, splat(step_x), splat(-c->tan_left));
    const Real sy = fma(y, splat(-step_y), splat(c->tan_up));
    return scale_add3(
        splat_vector(vector_at(c->right)), sx,
        scale_add3(splat_vector(vector_at(c->up)), sy, splat_vector(vector_at(c->forward))));
}

/* Blocks whose middle lies in the foveal disk. */
MACULA_ALWAYS_INLINE Mask in_disk(global const FrameParams* frame, global const RefreshPlan* plan,
                                  Uint x, Uint y) {
    const Uint left = x - x % MACULA_BLOCK_WIDTH, top = y - y % BLOCK_HEIGHT;
    const Real3 along =
        direction_through(frame, uint_to_real(left) + (float)(MACULA_BLOCK_WIDTH) * 0.5f,
                          uint_to_real(top) + (float)(BLOCK_HEIGHT)*0.5f);
    const Real cosine = dot3(along, splat_vector(vector_at(frame->gaze))) *
                        m_inverse_sqrt(dot3(along, along));
    return cosine >= splat(plan->cosine);
}

MACULA_ALWAYS_INLINE Mask is_foveal(global const FrameParams* frame, global const RefreshPlan* plan,
                                    Uint x, Uint y) {
    const Mask inside = in_rectangle(plan, x, y);
    return plan->disk != 0u ? inside & in_disk(frame, plan, x, y) : inside;
}

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

/* Of the foveal rectangle. ranks: the turns of the blocks of MACULA_REFRESH_ORDERS^2 groups. */
MACULA_ALWAYS_INLINE Pixels foveal_pixels(global const FrameParams* frame,
                                          global const RefreshPlan* plan, global const uint* ranks,
                                          uint index, Uint lane) {
    global const RefreshRegion* region = plan->region;
    uint column, row;
    place_packet(region, index, &column, &row);
    Pixels p;
    p.x = region->column + 4u * column + (lane & 3u);
    p.y = region->row + 4u * row + (lane >> 2);
    p.foveal = is_foveal(frame, plan, p.x, p.y);
    p.refreshed = p.foveal;
    if (plan->disk != 0u && any_lane(p.foveal == 0)) {
        const uint wide = MACULA_REFRESH_ORDERS * plan->group_width;
        const uint high = MACULA_REFRESH_ORDERS * plan->group_height;
        const Uint block_x = p.x / MACULA_BLOCK_WIDTH, block_y = p.y / BLOCK_HEIGHT;
        const Uint at = block_y % high * wide + block_x % wide;
        const Uint rank = MACULA_GATHER(uint, ranks, at, );
        const uint period = plan->corner_period;
        const Mask due = rank % period == splat_uint(plan->turn % period);
        p.refreshed = p.foveal | (due & in_rectangle(plan, p.x, p.y));
    }
    return p;
}

/* The blocks of the groups of the packet (column, row) at `turn`; none where the fovea is. */
MACULA_ALWAYS_INLINE Pixels due_pixels(global const RefreshPlan* plan, global const uint* orders,
                                       uint column, uint row, uint turn, Uint lane) {
    const Uint block = lane >> 2, pixel = lane & 3u, pixel_row = pixel / MACULA_BLOCK_WIDTH;
    const Uint group_x = column * GROUPS_ACROSS + block % GROUPS_ACROSS;
    const Uint group_y = row * GROUPS_DOWN + block / GROUPS_ACROSS;
    const Uint order = (group_y % MACULA_REFRESH_ORDERS) * MACULA_REFRESH_ORDERS +
                       group_x % MACULA_REFRESH_ORDERS;
    const Uint due = order * plan->group_blocks + turn;
    const Uint offset = MACULA_GATHER(uint, orders, due, );
    Pixels p;
    p.x = column * (4u * plan->group_width) + (offset & 0xffffu) * MACULA_BLOCK_WIDTH +
          pixel % MACULA_BLOCK_WIDTH;
    p.y = row * (4u * plan->group_height) + (offset >> 16) * BLOCK_HEIGHT + pixel_row;
    p.foveal = p.x != p.x; /* none */
    p.refreshed = in_rectangle(plan, p.x, p.y) == 0;
    return p;
}

MACULA_ALWAYS_INLINE Pixels peripheral_pixels(global const RefreshPlan* plan,
                                              global const uint* orders,
                                              global const RefreshRegion* region, uint index,
                                              Uint lane) {
    const uint passes = plan->group_blocks / region->period;
    const uint place = index / passes;
    uint column, row;
    place_packet(region, place, &column, &row);
    const uint turn = plan->turn % region->period + index % passes * region->period;
    return due_pixels(plan, orders, region->column + column, region->row + row, turn, lane);
}

/* From a number of the search for busy groups to theirs. */
MACULA_ALWAYS_INLINE uint quad_of_search(global const RefreshPlan* plan, uint index) {
    const ulong step = (ulong)(plan->first_quad + index) * MACULA_REFRESH_STRIDE;
    return (uint)(step % plan->quads);
}

/* Frames between two refreshes where a quad lies; 0: in the fovea. */
MACULA_ALWAYS_INLINE uint period_at(global const RefreshPlan* plan, uint column, uint row) {
    uint period = 0u;
    for (uint i = 0u; i < plan->regions; ++i) {
        global const RefreshRegion* r = plan->region + i;
        const bool here = column - r->column < r->columns && row - r->row < r->rows;
        period = here && r->period > 0u ? r->period : period;
    }
    return period;
}

/* Packet `index` of the busy groups: their blocks at turns between those that are due anyway. */
MACULA_ALWAYS_INLINE Pixels busy_pixels(global const RefreshPlan* plan, global const uint* orders,
                                        global const uint* busy, uint index, Uint lane) {
    const uint entry = index / plan->busy_packets, pass = index % plan->busy_packets + 1u;
    const uint quad = quad_of_search(plan, busy[entry]);
    const uint column = quad % plan->quads_across, row = quad / plan->quads_across;
    const uint blocks = plan->group_blocks, period = period_at(plan, column, row);
    const uint further = pass * blocks / (plan->busy_packets + 1u);
    Pixels p = due_pixels(plan, orders, column, row, (plan->turn + further) % blocks, lane);
    if (period == 0u || further % period == 0u)
        p.refreshed = p.foveal; /* none: they are due by themselves */
    return p;
}

#endif
