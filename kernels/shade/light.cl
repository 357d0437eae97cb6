/* Direct light: the queue of the surface points that one light may reach, their shadow rays, and
 * the sum of what arrives. */
#include "lib/light.h"
#include "lib/phong.h"
#include "shade/queue.h"
#include "shared/bvh.h"
#include "shared/ray.h"

/* How many places lie in a row of what a list's places name: pixels below width x height, and
 * texels of a method's own buffer beyond; 0 texels: there is none. */
typedef struct Rows {
    uint pixels, texels;
} Rows;

/* Where a light's samples for the surfaces of some slots come from. `noise`: null without lights
 * that take it. */
static inline LightDraw draw_of_slots(global const FrameParams* frame, uint sample,
                                      global const Light* lights, uint light, Rows rows,
                                      global const uint* noise, global const uint* places,
                                      Uint slot) {
    const Uint place = MACULA_GATHER(uint, places, slot, );
    const uint dimension = MACULA_DIMENSION_LIGHTS + light;
    Uint texel = splat_uint(0u);
    if (lights[light].columns == 0u) {
        const uint pixels = rows.texels > 0u ? frame->width * frame->height : MACULA_NO_PIXEL;
        const Mask beyond = place >= pixels;
        const Uint row = beyond ? splat_uint(rows.texels) : splat_uint(rows.pixels);
        const Uint at = beyond ? place - pixels : place;
        const uint shift = random_bits(random_mix(frame->seed), 0u, dimension);
        const Uint down = at / row;
        texel =
            MACULA_GATHER(uint, noise, noise_texel(at - down * row, down, frame->frame, shift), );
    }
    const Uint key = random_key(place, frame->frame, frame->seed);
    return make_light_draw(lights + light, frame, sample, dimension, key, texel);
}

/* flags[slot] = 1 where shadow rays are needed, up to the list's end; the first light clears the
 * sums. One work-item for MACULA_LANES slots of the launch. */
kernel void flag_lit_surfaces(global const uint* restrict ray_count,
                              global const uint* restrict triangle,
                              global const float4* restrict position,
                              global const float4* restrict geometric_normal,
                              global const Light* restrict lights, uint light,
                              global uint* restrict flags, global float4* restrict irradiance,
                              global float4* restrict highlight) {
    if (beyond_list(*ray_count))
        return;
    const uint first = first_of_item();
    const Real3 nothing = splat_vector(splat3(0.0f));
    if (light == 0u)
        store4(irradiance, first, nothing, splat(0.0f));
    if (light == 0u && highlight)
        store4(highlight, first, nothing, splat(0.0f));
    const Mask hit =
        (lanes_from(first) < *ray_count) & (load_uints(triangle, first) != MACULA_NO_TRIANGLE);
    const Mask lit = hit & light_may_reach(lights + light, load4(position, first).xyz,
                                           load4(geometric_normal, first).xyz);
    store_uints(flags, first, lit ? splat_uint(1u) : splat_uint(0u));
}

/* One work-item for MACULA_LANES rays of the batch, entry by entry. */
kernel void generate_shadow_rays(
    global const FrameParams* restrict frame, uint sample, global const Light* restrict lights,
    uint light, uint pixel_row, uint texel_row, global const uint* restrict noise,
    global const uint* restrict queue, global const uint* restrict queue_count, uint first,
    global const uint* restrict places, global const float4* restrict position,
    global const float4* restrict geometric_normal, global RayBlock* restrict rays,
    global uint* restrict ray_count, global ulong* restrict ray_totals, uint ray_class) {
    const uint count = batch_count(*queue_count, first);
    const uint samples = lights[light].samples;
    const uint capacity = (uint)get_global_size(0) * MACULA_LANES / samples;
    const uint total = batch_rays(count, samples, capacity);
    if (get_global_id(0) == 0u) {
        *ray_count = total;
        ray_totals[ray_class] += (count < capacity ? count : capacity) * samples;
    }
    if (first_of_item() >= total)
        return;
    const EntryRays r = load_entry_rays(queue, first, count, samples);
    const Lane4 surface = gather4(position, r.slot);
    const Real3 normal = gather4(geometric_normal, r.slot).xyz;
    const Real3 origin = scale_add3(normal, surface.w, surface.xyz);
    const Rows rows = {pixel_row, texel_row};
    const LightDraw draw = draw_of_slots(frame, sample, lights, light, rows, noise, places, r.slot);
    LightSample s;
    sample_light(lights + light, &draw, surface.xyz, r.sample, &s);
    const Mask above =
        r.used & (s.weight > splat(0.0f)) & (dot3(s.direction, normal) > splat(0.0f));
    store_rays(rays, r.first, origin, s.direction, above ? s.t_max : splat(-1.0f));
}

/* What one light gives to a point: the sums over its samples. */
typedef struct Received {
    Real diffuse; /* irradiance */
    Real glossy;  /* irradiance facing the light times Phong's lobe */
} Received;

/* Adds the light's unoccluded samples to the irradiance and, where specular materials exist, to
 * the highlight. `origin`: of each slot's ray; null: the camera's. */
kernel void add_light(global const FrameParams* restrict frame, uint sample,
                      global const Light* restrict lights, uint light, uint pixel_row,
                      uint texel_row, global const uint* restrict noise,
                      global const uint* restrict queue, global const uint* restrict queue_count,
                      uint first, global const uint* restrict places,
                      global const float4* restrict position,
                      global const float4* restrict geometric_normal,
                      global const float4* restrict shading_normal,
                      global const float4* restrict specular,
                      global const float4* restrict origin, global const uint* restrict occluded,
                      global float4* restrict irradiance, global float4* restrict highlight) {
    const uint count = batch_count(*queue_count, first);
    if (first_of_item() >= count)
        return;
    const Entries e = load_entries(queue, first, count);
    const Real3 from = gather4(position, e.slot).xyz;
    const Real3 above = gather4(geometric_normal, e.slot).xyz;
    const Real3 normal = gather4(shading_normal, e.slot).xyz;
    const Real3 eye = origin ? gather4(origin, e.slot).xyz
                             : splat_vector(vector_at(frame->camera.origin));
    const Real3 to_viewer = unit3(sub3(eye, from), normal);
    const Real shininess = highlight ? gather4(specular, e.slot).w : splat(1.0f);
    const Rows rows = {pixel_row, texel_row};
    const LightDraw draw = draw_of_slots(frame, sample, lights, light, rows, noise, places, e.slot);
    const uint samples = lights[light].samples;
    const Real zero = splat(0.0f);
    Received sum = {zero, zero};
    for (uint index = 0u; index < samples; ++index) {
        const Uint ray = lanes_from(e.first) * samples + index;
        const Mask open = e.used & (MACULA_GATHER(uint, occluded, ray, ) == 0u);
        if (!any_lane(open))
            continue;
        LightSample s;
        sample_light(lights + light, &draw, from, splat_uint(index), &s);
        const Real cosine = dot3(normal, s.unit_direction);
        const Mask lit = open & (s.weight > zero) & (s.t_max > zero) & (cosine > zero) &
                         (dot3(above, s.direction) > zero);
        sum.diffuse = lit ? fma(s.weight, cosine, sum.diffuse) : sum.diffuse;
        if (highlight) {
            const Real lobe = phong_lobe(normal, s.unit_direction, to_viewer, shininess);
            sum.glossy = lit ? fma(s.weight, lobe, sum.glossy) : sum.glossy;
        }
    }
    const Real scale = splat(m_divide(1.0f, (float)samples));
    const Real3 colour = splat_vector(vector_at(lights[light].colour));
    const Real3 before = gather4(irradiance, e.slot).xyz;
    scatter4(irradiance, e.slot, e.used, scale_add3(colour, sum.diffuse * scale, before), zero);
    if (highlight) {
        const Real3 shine = gather4(highlight, e.slot).xyz;
        scatter4(highlight, e.slot, e.used, scale_add3(colour, sum.glossy * scale, shine), zero);
    }
}
