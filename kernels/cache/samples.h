/* Samples on their way into the cache (Weier et al. 2016, section 3.4). A packet of the periphery
 * has two or three: those of MACULA_PACKETS packets wait for one another and are blended sixteen at
 * a time. */
#ifndef MACULA_CACHE_SAMPLES_H
#define MACULA_CACHE_SAMPLES_H

#include "cache/blend.h"
#include "cache/light_value.h"

#define MOST_WAITING (MACULA_PACKETS * 16u)

/* What the samples bring, slot by slot. */
typedef struct Samples {
    global const float4* colour;
    global const float* depth;
    global const LightValue* light;
} Samples;

/* A pixel's new state. `light` may be null. */
typedef struct Out {
    global float4* colour;
    global uint2* info;
    global LightValue* light;
} Out;

/* No history's inverse depth. */
#define NO_HISTORY (-1e30f)

/* The pixels and slots of samples; the inverse depth of the history that the pixel holds already,
 * NO_HISTORY where the sample takes its place. */
typedef struct Waiting {
    uint count;
    uint pixel[MOST_WAITING], slot[MOST_WAITING];
    float inverse_depth[MOST_WAITING];
} Waiting;

MACULA_ALWAYS_INLINE void let_wait(Waiting* waiting, uint pixel, uint slot, float inverse_depth) {
    waiting->pixel[waiting->count] = pixel;
    waiting->slot[waiting->count] = slot;
    waiting->inverse_depth[waiting->count] = inverse_depth;
    ++waiting->count;
}

static inline void put_sample(const Samples* samples, uint slot, uint pixel, float alpha,
                              const Out* out) {
    const float4 fresh = samples->colour[slot], old = out->colour[pixel];
    const float4 mixed = fma(fresh - old, (float4)(alpha), old);
    out->colour[pixel] = alpha < 1.0f ? (float4)(mixed.xyz, 1.0f) : fresh;
    if (out->light) {
        const LightValue lit = samples->light[slot], before = out->light[pixel];
        out->light[pixel] =
            alpha < 1.0f && is_lit(before) ? fma(lit - before, (LightValue)(alpha), before) : lit;
    }
}

/* The samples from `first` on, sixteen or as many as wait. */
MACULA_ALWAYS_INLINE void blend_sixteen(global const WeierParams* weier, uint now,
                                        const Waiting* waiting, uint first, const Samples* samples,
                                        const Out* out) {
    const uint *pixel = waiting->pixel + first, *slot = waiting->slot + first;
    float depth[16];
    uint infos[32];
    for (uint n = 0u; n < 16u; ++n) {
        depth[n] = samples->depth[slot[n]];
        vstore2(out->info[pixel[n]], n, infos);
    }
    const uint16 upper = vload16(0, infos), lower = vload16(1, infos);
    const float16 inverse_depth = vload16(0, waiting->inverse_depth + first);
    const int16 kept = inverse_depth != NO_HISTORY;
    const float16 known = kept ? inverse_depth : (float16)(0.0f);
    const float16 apart = fabs(fma(vload16(0, depth), known, (float16)(-1.0f)));
    const Blend blend =
        weigh_samples(weier, now, kept & (apart <= weier->merge_threshold),
                      as_float16((uint16)(upper.even, lower.even)), (uint16)(upper.odd, lower.odd));
    float alpha[16], rho[16];
    uint touch[16];
    vstore16(blend.alpha, 0, alpha);
    vstore16(blend.rho, 0, rho);
    vstore16(blend.touch, 0, touch);
    const uint count = min(waiting->count - first, 16u);
    for (uint n = 0u; n < count; ++n) {
        put_sample(samples, slot[n], pixel[n], alpha[n], out);
        out->info[pixel[n]] = (uint2)(as_uint(rho[n]), touch[n]);
    }
}

/* The last one is repeated until they are a multiple of sixteen. */
MACULA_ALWAYS_INLINE void blend_waiting(global const WeierParams* weier, uint now, Waiting* waiting,
                                        const Samples* samples, const Out* out) {
    const uint count = waiting->count;
    while ((waiting->count & 15u) != 0u)
        let_wait(waiting, waiting->pixel[count - 1u], waiting->slot[count - 1u], NO_HISTORY);
    waiting->count = count;
    for (uint first = 0u; first < count; first += 16u)
        blend_sixteen(weier, now, waiting, first, samples, out);
}

#endif
