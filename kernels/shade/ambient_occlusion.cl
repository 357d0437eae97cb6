/* Ambient occlusion: the cosine-weighted part of the hemisphere that is open within a radius. */
#include "lib/sampling.h"
#include "shade/queue.h"
#include "shared/camera.h"

/* flags[slot] = 1 where something was hit, up to the list's end; openness begins as 0. One
 * work-item for MACULA_LANES slots of the launch. */
kernel void flag_surfaces(global const uint* restrict ray_count,
                          global const uint* restrict triangle, global uint* restrict flags,
                          global float* restrict openness) {
    if (beyond_list(*ray_count))
        return;
    const uint first = first_of_item();
    store_reals(openness, first, splat(0.0f));
    const Uint slot = lanes_from(first);
    const Mask hit = (slot < *ray_count) & (load_uints(triangle, first) != MACULA_NO_TRIANGLE);
    store_uints(flags, first, hit ? splat_uint(1u) : splat_uint(0u));
}

/* One work-item for MACULA_LANES entries of the batch. */
kernel void generate_ambient_occlusion_rays(
    global const FrameParams* restrict frame, uint sample, global const uint* restrict queue,
    global const uint* restrict queue_count, uint first, global const uint* restrict pixels,
    global const float4* restrict position, global const float4* restrict geometric_normal,
    global const float4* restrict shading_normal, global RayBlock* restrict rays,
    global uint* restrict ray_count, global ulong* restrict ray_totals, uint ray_class) {
    const uint count = batch_count(*queue_count, first);
    const uint samples = frame->ambient_occlusion_samples;
    if (get_global_id(0) == 0u) {
        const uint capacity = (uint)get_global_size(0) * MACULA_LANES;
        *ray_count = batch_rays(count, samples, capacity);
        ray_totals[ray_class] += (count < capacity ? count : capacity) * samples;
    }
    if (first_of_item() >= padded_count(count))
        return;
    const Entries e = load_entries(queue, first, count);
    const Lane4 surface = gather4(position, e.slot);
    const Real3 upwards = splat_vector(make3(0.0f, 0.0f, 1.0f));
    const Real3 above = select3(e.used, gather4(geometric_normal, e.slot).xyz, upwards);
    const Real3 normal = select3(e.used, gather4(shading_normal, e.slot).xyz, upwards);
    const Real3 origin = scale_add3(above, surface.w, surface.xyz);
    const Uint key = random_key(MACULA_GATHER(uint, pixels, e.slot, ), frame->frame, frame->seed);
    const Strata strata = make_strata(frame->ambient_occlusion_columns, samples);
    const Basis basis = make_basis(normal);
    const Real t_max = e.used ? splat(frame->ambient_occlusion_radius) : splat(-1.0f);
    for (uint index = 0u; index < samples; ++index) {
        Real u, v;
        stratified_point(key, splat_uint(sample * samples + index),
                         MACULA_DIMENSION_AMBIENT_OCCLUSION, splat_uint(index), &strata, &u, &v);
        const Real3 direction = cosine_direction(&basis, u, v);
        /* A bent shading normal sends some rays into the surface: they are mirrored out of it, or
         * they would darken every smooth silhouette. */
        const Real height = dot3(direction, above);
        const Real3 mirrored = scale_add3(above, -2.0f * height, direction);
        store_rays(rays, queued_ray(e.first, index, samples), origin,
                   select3(height < splat(0.0f), mirrored, direction), t_max);
    }
}

/* openness[slot]: part of the rays that hit nothing. */
kernel void average_ambient_occlusion(global const FrameParams* restrict frame,
                                      global const uint* restrict queue,
                                      global const uint* restrict queue_count, uint first,
                                      global const uint* restrict occluded,
                                      global float* restrict openness) {
    const uint count = batch_count(*queue_count, first);
    if (first_of_item() >= count)
        return;
    const Entries e = load_entries(queue, first, count);
    const uint samples = frame->ambient_occlusion_samples;
    Uint open = splat_uint(0u);
    for (uint index = 0u; index < samples; ++index) {
        const Uint hit = load_uints(occluded, queued_ray(e.first, index, samples));
        open += hit == 0u ? splat_uint(1u) : splat_uint(0u);
    }
    scatter_reals(openness, e.slot, e.used, m_divide(uint_to_real(open), splat((float)samples)));
}
