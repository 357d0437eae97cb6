/* Random numbers without state: each is a hash of (pixel, frame, sample, dimension, seed). */
#ifndef MACULA_LIB_RANDOM_H
#define MACULA_LIB_RANDOM_H

#include "shared/language.h"

MACULA_SHARED_BEGIN

/* Dimensions, so that no two uses share a number. */
#define MACULA_DIMENSION_PIXEL 0u /* and the next one */
#define MACULA_DIMENSION_AMBIENT_OCCLUSION 2u
#define MACULA_DIMENSION_FOVEA 3u
#define MACULA_DIMENSION_FOOTPRINT 4u    /* and the next one */
#define MACULA_DIMENSION_LIGHT_FILTER 6u /* and the next one */
#define MACULA_DIMENSION_LIGHTS 16u /* + light */

/* Wellons' `lowbias32`: a bijection of 32 bits with a near-ideal avalanche. */
MACULA_ALWAYS_INLINE uint random_mix(uint x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}

/* What the numbers of one pixel and frame have in common; computed once by a work-item. */
MACULA_ALWAYS_INLINE uint random_key(uint pixel, uint frame, uint seed) {
    return random_mix(pixel + random_mix(frame + random_mix(seed ^ 0x9e3779b9u)));
}

MACULA_ALWAYS_INLINE uint random_bits(uint key, uint sample, uint dimension) {
    return random_mix(key ^ random_mix(sample * 0x9e3779b1u + dimension * 0x85ebca77u));
}

/* Uniform in [0, 1), a multiple of 2^-24. */
MACULA_ALWAYS_INLINE float random_unit(uint key, uint sample, uint dimension) {
    return (float)(random_bits(key, sample, dimension) >> 8) * 0x1p-24f;
}

MACULA_SHARED_END
#endif
