/* Ambient occlusion: the cosine-weighted part of the hemisphere that is open within a radius. */
#include "lib/camera.h"
#include "lib/sampling.h"
#include "shade/queue.h"

/* flags[slot] = 1 where something was hit, up to the list's end. One work-item a slot of the
 * launch. */
kernel void flag_surfaces(global const uint* restrict ray_count,
                          global const uint* restrict triangle, global uint* restrict flags) {
    const uint slot = get_global_id(0);
    if (beyond_list(*ray_count))
        return;
    flags[slot] = slot < *ray_count && triangle[slot] != MACULA_NO_TRIANGLE;
}

/* One work-item an entry of the batch. */
kernel void generate_ambient_occlusion_rays(
    global const FrameParams* restrict frame, uint sample, global const uint* restrict queue,
    global const uint* restrict queue_count, uint first, global const uint* restrict pixels,
    global const float4* restrict position, global const float4* restrict geometric_normal,
    global const float4* restrict shading_normal, global RayBlock* restrict rays,
    global uint* restrict ray_count, global ulong* restrict ray_totals, uint ray_class) {
    const uint entry = get_global_id(0), count = batch_count(*queue_count, first);
    const uint samples = frame->ambient_occlusion_samples;
    if (entry == 0u) {
        const uint capacity = (uint)get_global_size(0);
        *ray_count = batch_rays(count, samples, capacity);
        ray_totals[ray_class] += (count < capacity ? count : capacity) * samples;
    }
    if (entry >= padded_count(count))
        return;
    const bool used = entry < count;
    const uint slot = used ? queue[first + entry] : 0u;
    const float4 surface = used ? position[slot] : (float4)(0.0f);
    const float3 above = used ? geometric_normal[slot].xyz : (float3)(0.0f, 0.0f, 1.0f);
    const float3 normal = used ? shading_normal[slot].xyz : above;
    const float3 origin = scale_add3(above, surface.w, surface.xyz);
    const uint key = used ? random_key(pixels[slot], frame->frame, frame->seed) : 0u;
    const Strata strata = make_strata(frame->ambient_occlusion_columns, samples);
    const Basis basis = make_basis(normal);
    for (uint index = 0u; index < samples; ++index) {
        float u, v;
        stratified_point(key, sample * samples + index, MACULA_DIMENSION_AMBIENT_OCCLUSION, index,
                         &strata, &u, &v);
        float3 direction = cosine_direction(&basis, u, v);
        /* A bent shading normal sends some rays into the surface: they are mirrored out of it, or
         * they would darken every smooth silhouette. */
        const float height = dot3(direction, above);
        direction = height < 0.0f ? scale_add3(above, -2.0f * height, direction) : direction;
        store_ray(rays, queued_ray(entry, index, samples), origin, direction,
                  used ? frame->ambient_occlusion_radius : -1.0f);
    }
}

/* openness[slot]: part of the rays that hit nothing. */
kernel void average_ambient_occlusion(global const FrameParams* restrict frame,
                                      global const uint* restrict queue,
                                      global const uint* restrict queue_count, uint first,
                                      global const uint* restrict occluded,
                                      global float* restrict openness) {
    const uint entry = get_global_id(0);
    if (entry >= batch_count(*queue_count, first))
        return;
    const uint samples = frame->ambient_occlusion_samples;
    uint open = 0u;
    for (uint index = 0u; index < samples; ++index)
        open += occluded[queued_ray(entry, index, samples)] == 0u ? 1u : 0u;
    openness[queue[first + entry]] = m_divide((float)open, (float)samples);
}
