/* Phong shading of the G-buffer with the light buffer (lib/phong.h). Inputs that a method lacks
 * are null: no direct light, no highlights, no ambient occlusion, nothing that takes a part of the
 * diffuse colour. */
#include "lib/camera.h"
#include "lib/phong.h"
#include "shared/ray.h"
#include "shared/surface.h"

/* One work-item a slot. */
kernel void
shade_samples(global const FrameParams* restrict frame, global const uint* restrict ray_count,
              global const float4* restrict albedo, global const float4* restrict specular,
              global const float4* restrict emission, global const float4* restrict irradiance,
              global const float4* restrict highlight, global const float* restrict openness,
              global const uint* restrict material, global const SurfaceOptics* restrict optics,
              global float4* restrict colour) {
    const uint slot = get_global_id(0);
    if (slot >= *ray_count)
        return;
    float3 reflected = vector_at(frame->ambient);
    if (openness)
        reflected = reflected * openness[slot];
    if (irradiance)
        reflected = reflected + irradiance[slot].xyz;
    float3 diffuse = albedo[slot].xyz;
    if (optics && material[slot] != MACULA_NO_TRIANGLE)
        diffuse = diffuse * vector_at(optics[material[slot]].diffuse_part);
    float3 radiance = fma3(diffuse, reflected, emission[slot].xyz);
    if (highlight)
        radiance = fma3(specular[slot].xyz, highlight[slot].xyz, radiance);
    colour[slot] = (float4)(radiance, 1.0f);
}
