/* From ray slots to the pixels of an image. */
#include "lib/camera.h"

/* Adds sample `sample` of each slot to its pixel; after the last one the sum becomes the mean. The
 * order of the samples is fixed, hence also the sum. One work-item a slot; a pixel has one slot. */
kernel void average_samples(global const FrameParams* restrict frame, uint sample,
                            global const uint* restrict ray_count,
                            global const uint* restrict pixels,
                            global const float4* restrict samples, global float4* restrict image) {
    const uint slot = get_global_id(0);
    if (slot >= *ray_count || pixels[slot] == MACULA_NO_PIXEL)
        return;
    const uint pixel = pixels[slot], count = frame->samples_per_pixel;
    float4 sum = samples[slot];
    sum = sample == 0u ? sum : image[pixel] + sum;
    image[pixel] = sample + 1u == count ? sum * m_divide(1.0f, (float)count) : sum;
}

kernel void average_scalar_samples(global const FrameParams* restrict frame, uint sample,
                                   global const uint* restrict ray_count,
                                   global const uint* restrict pixels,
                                   global const float* restrict samples,
                                   global float* restrict image) {
    const uint slot = get_global_id(0);
    if (slot >= *ray_count || pixels[slot] == MACULA_NO_PIXEL)
        return;
    const uint pixel = pixels[slot], count = frame->samples_per_pixel;
    float sum = samples[slot];
    sum = sample == 0u ? sum : image[pixel] + sum;
    image[pixel] = sample + 1u == count ? sum * m_divide(1.0f, (float)count) : sum;
}

/* The same without going to pixels: for lists, whose slots stay. `components`: floats a slot. */
kernel void average_listed(global const FrameParams* restrict frame, uint sample, uint components,
                           global const uint* restrict ray_count,
                           global const float* restrict samples, global float* restrict means) {
    const uint slot = get_global_id(0);
    if (slot >= *ray_count)
        return;
    const uint count = frame->samples_per_pixel;
    for (uint i = slot * components; i < (slot + 1u) * components; ++i) {
        const float sum = sample == 0u ? samples[i] : means[i] + samples[i];
        means[i] = sample + 1u == count ? sum * m_divide(1.0f, (float)count) : sum;
    }
}

/* Copies the first sample's words to its pixel: for what has no meaningful mean (ids, positions,
 * normals). `words`: 32-bit words an element. */
kernel void keep_first_sample(uint words, global const uint* restrict ray_count,
                              global const uint* restrict pixels,
                              global const uint* restrict samples, global uint* restrict image) {
    const uint slot = get_global_id(0);
    if (slot >= *ray_count || pixels[slot] == MACULA_NO_PIXEL)
        return;
    const uint pixel = pixels[slot];
    for (uint word = 0u; word < words; ++word)
        image[pixel * words + word] = samples[slot * words + word];
}
