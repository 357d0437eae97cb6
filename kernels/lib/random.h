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
#define MACULA_DIMENSION_LIGHTS 16u      /* + light */

#define MACULA_WIDTH
#include "lib/random_functions.h"
#undef MACULA_WIDTH

MACULA_SHARED_END
#endif
