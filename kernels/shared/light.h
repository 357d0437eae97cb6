/* Light sources as the kernels see them: what `--lights` makes of the scene's lights. */
#ifndef MACULA_SHARED_LIGHT_H
#define MACULA_SHARED_LIGHT_H

#include "shared/language.h"

MACULA_SHARED_BEGIN

#define MACULA_LIGHT_POINT 0u        /* isotropic */
#define MACULA_LIGHT_COSINE_POINT 1u /* a rectangle shrunk to its centre: cosine about direction   \
                                      */
#define MACULA_LIGHT_DIRECTIONAL 2u
#define MACULA_LIGHT_SPHERE 3u
#define MACULA_LIGHT_RECTANGLE 4u

/* colour, linear RGB: intensity (point, sphere), intensity along the normal (cosine point,
 * rectangle), irradiance of a surface that faces the light (directional); each over pi, so that a
 * white Lambertian surface reflects what it receives (lib/phong.h). */
typedef struct Light {
    float position[3]; /* centre */
    uint kind;
    float colour[3];
    /* Sphere: of the emitter. Point: shadow rays end at this distance from it, so that a bulb's
     * own geometry does not darken the point light in its middle. Directional: 1 - cos of the
     * angular radius; 0: all its light comes from one direction. */
    float radius;
    float direction[3]; /* unit: directional, the way light travels; rectangle, its normal */
    /* Square of the distance at which the inverse square law gives `colour`; 0: no falloff. */
    float reference_distance_squared;
    float edge_u[3]; /* rectangle: full edges */
    uint samples;    /* shadow rays a pixel sample */
    float edge_v[3];
    uint columns; /* of the grid of strata; divides `samples`. 0: blue noise instead of strata */
} Light;
MACULA_ASSERT_SIZE(Light, 80);

MACULA_SHARED_END
#endif
