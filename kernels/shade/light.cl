/* Direct light: the queue of the surface points that one light may reach, their shadow rays, and
 * the sum of what arrives. */
#include "lib/light.h"
#include "lib/phong.h"
#include "shade/queue.h"
#include "shared/bvh.h"
#include "shared/ray.h"

/* flags[slot] = 1 where shadow rays are needed, up to the list's end. One work-item a slot of the
 * launch. */
kernel void flag_lit_surfaces(global const uint* restrict ray_count,
                              global const uint* restrict triangle,
                              global const float4* restrict position,
                              global const float4* restrict geometric_normal,
                              global const Light* restrict lights, uint light,
                              global uint* restrict flags) {
    const uint slot = get_global_id(0);
    if (beyond_list(*ray_count))
        return;
    const bool hit = slot < *ray_count && triangle[slot] != MACULA_NO_TRIANGLE;
    flags[slot] =
        hit && light_may_reach(lights + light, position[slot].xyz, geometric_normal[slot].xyz);
}

/* One work-item an entry of the batch; it makes the rays of all of the light's samples. */
kernel void generate_shadow_rays(
    global const FrameParams* restrict frame, uint sample, global const Light* restrict lights,
    uint light, global const uint* restrict queue, global const uint* restrict queue_count,
    uint first, global const uint* restrict pixels, global const float4* restrict position,
    global const float4* restrict geometric_normal, global RayBlock* restrict rays,
    global uint* restrict ray_count, global ulong* restrict ray_totals, uint ray_class) {
    const uint entry = get_global_id(0), count = batch_count(*queue_count, first);
    const uint samples = lights[light].samples;
    const Strata strata = make_strata(lights[light].columns, samples);
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
    const float3 normal = used ? geometric_normal[slot].xyz : (float3)(0.0f);
    const float3 origin = scale_add3(normal, surface.w, surface.xyz);
    const uint key = used ? random_key(pixels[slot], frame->frame, frame->seed) : 0u;
    for (uint index = 0u; index < samples; ++index) {
        LightSample s;
        sample_light(lights + light, &strata, surface.xyz, key, sample,
                     MACULA_DIMENSION_LIGHTS + light, index, &s);
        const bool above = used && s.weight > 0.0f && dot3(s.direction, normal) > 0.0f;
        store_ray(rays, queued_ray(entry, index, samples), origin, s.direction,
                  above ? s.t_max : -1.0f);
    }
}

/* Adds the light's unoccluded samples to the irradiance and, where specular materials exist, to
 * the highlight: irradiance facing the light times Phong's lobe. */
kernel void add_light(global const FrameParams* restrict frame, uint sample,
                      global const Light* restrict lights, uint light,
                      global const uint* restrict queue, global const uint* restrict queue_count,
                      uint first, global const uint* restrict pixels,
                      global const float4* restrict position,
                      global const float4* restrict geometric_normal,
                      global const float4* restrict shading_normal,
                      global const float4* restrict specular, global const uint* restrict occluded,
                      global float4* restrict irradiance, global float4* restrict highlight) {
    const uint entry = get_global_id(0);
    if (entry >= batch_count(*queue_count, first))
        return;
    const uint slot = queue[first + entry];
    const float3 from = position[slot].xyz;
    const float3 above = geometric_normal[slot].xyz, normal = shading_normal[slot].xyz;
    const float3 to_viewer = unit3(vector_at(frame->camera.origin) - from, normal);
    const uint key = random_key(pixels[slot], frame->frame, frame->seed);
    const uint samples = lights[light].samples;
    const Strata strata = make_strata(lights[light].columns, samples);
    float diffuse = 0.0f, glossy = 0.0f;
    for (uint index = 0u; index < samples; ++index) {
        if (occluded[queued_ray(entry, index, samples)] != 0u)
            continue;
        LightSample s;
        sample_light(lights + light, &strata, from, key, sample, MACULA_DIMENSION_LIGHTS + light,
                     index, &s);
        const float cosine = dot3(normal, s.unit_direction);
        if (!(s.weight > 0.0f && s.t_max > 0.0f && cosine > 0.0f &&
              dot3(above, s.direction) > 0.0f))
            continue;
        diffuse = fma(s.weight, cosine, diffuse);
        if (highlight)
            glossy = fma(s.weight,
                         phong_lobe(normal, s.unit_direction, to_viewer, specular[slot].w), glossy);
    }
    const float scale = m_divide(1.0f, (float)samples);
    const float3 colour = vector_at(lights[light].colour);
    irradiance[slot] = (float4)(scale_add3(colour, diffuse * scale, irradiance[slot].xyz), 0.0f);
    if (highlight)
        highlight[slot] = (float4)(scale_add3(colour, glossy * scale, highlight[slot].xyz), 0.0f);
}
