/* Refresh rate modulation (Smith et al. 2014): the rays of the pixels that a frame refreshes, in
 * the order of the plan (shared/rrm.h). A pixel of a packet that is not refreshed leaves its slot
 * inactive. */
#include "refresh/places.h"

/* Packets of a sample: those beyond the periphery's last one have the fovea alone. `found`: busy
 * quads. */
MACULA_ALWAYS_INLINE uint packets_of_sample(global const RefreshPlan* plan,
                                            global const uint* found, uint sample) {
    if (sample >= plan->samples)
        return plan->foveal_packets;
    if (plan->busy_packets == 0u)
        return plan->packets;
    const uint busy = *found < plan->busy_quads ? *found : plan->busy_quads;
    return plan->packets + busy * plan->busy_packets;
}

MACULA_ALWAYS_INLINE Pixels listed_pixels(global const FrameParams* frame,
                                          global const RefreshPlan* plan, global const uint* orders,
                                          global const uint* ranks, global const uint* busy,
                                          uint packet, Uint lane) {
    Pixels p;
    if (packet < plan->foveal_packets) {
        p = foveal_pixels(frame, plan, ranks, packet, lane);
    } else if (packet >= plan->packets) {
        p = busy_pixels(plan, orders, busy, packet - plan->packets, lane);
    } else {
        global const RefreshRegion* region = plan->region;
        for (uint i = 1u; i < plan->regions && packet >= plan->region[i].first; ++i)
            ++region;
        p = peripheral_pixels(plan, orders, region, packet - region->first, lane);
    }
    p.refreshed = p.refreshed & (p.x < frame->width) & (p.y < frame->height);
    return p;
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

/* One work-item as many slots as it has lanes. counts: the refreshed pixels of each. busy, found:
 * null where nobody looks for busy groups. */
kernel void generate_refreshed_rays(global const FrameParams* restrict frame,
                                    global const RefreshPlan* restrict plan,
                                    global const uint* restrict orders,
                                    global const uint* restrict ranks,
                                    global const uint* restrict busy,
                                    global const uint* restrict found, uint sample,
                                    global RayBlock* restrict rays, global uint* restrict pixels,
                                    global uint* restrict ray_count, global uint* restrict counts) {
    const uint first = first_of_item(), packet = first / MACULA_RAY_BLOCK;
    const uint packets = packets_of_sample(plan, found, sample);
    if (first == 0u)
        *ray_count = packets * MACULA_RAY_BLOCK;
    if (packet >= packets) {
        counts[get_global_id(0)] = 0u;
        return;
    }
    const Uint lane = lanes_from(first) % MACULA_RAY_BLOCK;
    Pixels p = listed_pixels(frame, plan, orders, ranks, busy, packet, lane);
    if (sample >= plan->samples)
        p.refreshed = p.refreshed & p.foveal;
    const Uint pixel = p.y * frame->width + p.x;
    const Uint key = random_key(pixel, frame->frame, frame->seed);
    Real dx, dy;
    offset_in_pixel(key, sample, frame->sample_grid, &dx, &dy);
    if (plan->foveal_samples > plan->samples) {
        Real foveal_dx, foveal_dy;
        offset_in_pixel(key, sample, plan->foveal_grid, &foveal_dx, &foveal_dy);
        dx = p.foveal ? foveal_dx : dx;
        dy = p.foveal ? foveal_dy : dy;
    }
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
