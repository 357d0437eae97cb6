/* What lies between the stages of the method, as images to look at. */
#include "lib/acuity.h"
#include "lib/cache_info.h"
#include "lib/camera.h"
#include "lib/reprojection.h"

/* 0: not sampled, 1: sampled and blended with the cache, 2: taken as it is. */
static inline uint sampling_of(uint mask, uint lane) {
    const uint sampled = mask >> lane & 1u, fresh = mask >> (lane + 16u) & 1u;
    return sampled + (sampled & fresh);
}

/* The nearest support sample of a pixel. */
static inline uint support_of(global const FrameParams* frame, global const WeierParams* weier,
                              uint x, uint y) {
    const uint i = (uint)place_in_support(x, frame->width, weier->support_width);
    const uint j = (uint)place_in_support(y, frame->height, weier->support_height);
    return min(j, weier->support_height - 1u) * weier->support_width +
           min(i, weier->support_width - 1u);
}

/* MACULA_RESAMPLE_* of the cell that a pixel belongs to. */
static inline uint errors_of_key(global const WeierParams* weier, global const uint* errors,
                                 uint kept, uint key) {
    if (kept == 0u || key == MACULA_NO_KEY)
        return MACULA_RESAMPLE_NEW;
    const uint cell = cell_of_key(key, weier);
    const uint i = cell & ((1u << weier->cell_bits_x) - 1u), j = cell >> weier->cell_bits_x;
    return errors[j * weier->support_width + i] & ~MACULA_CELL_IN_VIEW;
}

/* One work-item a slot. Each output may be null. */
kernel void show_intermediates(global const FrameParams* restrict frame,
                               global const WeierParams* restrict weier,
                               global const uint* restrict masks, global const uint* restrict keys,
                               global const uint* restrict kept, global const uint* restrict errors,
                               global const uint2* restrict info,
                               global const float4* restrict support,
                               global uint* restrict sampling, global uint* restrict resampling,
                               global uint* restrict age, global float* restrict rho,
                               global float4* restrict support_colour) {
    const uint slot = (uint)get_global_id(0);
    const uint width = frame->width;
    uint x, y;
    pixel_of_slot(slot, width, &x, &y);
    if (x >= width || y >= frame->height)
        return;
    const uint pixel = y * width + x;
    if (sampling)
        sampling[pixel] = sampling_of(masks[slot / 16u], slot % 16u);
    if (resampling)
        resampling[pixel] = errors_of_key(weier, errors, *kept, keys[y * weier->pitch + x]);
    const float samples = as_float(info[pixel].x);
    if (rho)
        rho[pixel] = samples;
    if (age)
        age[pixel] = samples > 0.0f ? (frame->frame - info[pixel].y) & MACULA_TOUCHED_MASK
                                    : MACULA_TOUCHED_MASK;
    if (support_colour)
        support_colour[pixel] = support[support_of(frame, weier, x, y)];
}

/* Within half a pixel of an eccentricity. */
static inline bool on_circle(float eccentricity, float radius, float pixel_degrees) {
    return fabs(eccentricity - radius) < pixel_degrees;
}

/* The image with the sampled pixels tinted (green: blended, red: taken as they are outside of r0)
 * and white circles at r0 and r1. One work-item a slot. */
kernel void draw_overlay(global const FrameParams* restrict frame,
                         global const WeierParams* restrict weier,
                         global const uint* restrict masks, global const float4* restrict image,
                         global float4* restrict colour) {
    const uint slot = (uint)get_global_id(0);
    const uint width = frame->width, height = frame->height;
    uint x, y;
    pixel_of_slot(slot, width, &x, &y);
    if (x >= width || y >= height)
        return;
    const uint pixel = y * width + x;
    const float3 direction =
        camera_direction(&frame->camera, width, height, (float)x + 0.5f, (float)y + 0.5f);
    const float cosine =
        dot3(direction, vector_at(frame->gaze)) * m_inverse_sqrt(dot3(direction, direction));
    const float eccentricity = eccentricity_of_cosine(cosine);
    const float r0 = weier->r0 * frame->gaze_widening, r1 = weier->r1 * frame->gaze_widening;
    const uint sampling = sampling_of(masks[slot / 16u], slot % 16u);
    float4 shown = image[pixel];
    if (sampling != 0u && eccentricity > r0)
        shown = fma(
            (sampling == 2u ? (float4)(1.0f, 0.0f, 0.0f, 1.0f) : (float4)(0.0f, 1.0f, 0.0f, 1.0f)) -
                shown,
            (float4)(0.4f), shown);
    const float pixel_degrees = frame->pixel_spread * MACULA_DEGREES_OF_RADIAN;
    if (on_circle(eccentricity, r0, pixel_degrees) || on_circle(eccentricity, r1, pixel_degrees))
        shown = (float4)(1.0f);
    colour[pixel] = shown;
}
