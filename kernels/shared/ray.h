/* Rays and hits as they lie in device memory: blocks of sixteen, structure of arrays inside a
 * block, so that one float16 load fetches a component of a packet and sixteen neighbouring
 * work-items of a GPU read one line. Ray i is lane i % 16 of block i / 16. */
#ifndef MACULA_SHARED_RAY_H
#define MACULA_SHARED_RAY_H

#include "shared/language.h"

MACULA_SHARED_BEGIN

#define MACULA_RAY_BLOCK 16u
/* HitBlock.triangle of a ray that hit nothing. */
#define MACULA_NO_TRIANGLE 0xffffffffu

/* Origin and direction in world space; a hit at t lies at origin + t * direction, and counts when
 * t_min <= t <= t_max, both ends included. Directions need not have unit length. A ray with
 * !(0 <= t_min <= t_max) is inactive and misses: that is how a last block is filled up. */
typedef struct RayBlock {
    float origin_x[16], origin_y[16], origin_z[16];
    float t_min[16];
    float direction_x[16], direction_y[16], direction_z[16];
    float t_max[16];
} RayBlock;
MACULA_ASSERT_SIZE(RayBlock, 512);

/* Closest hit. `u` and `v` are the barycentric weights of the triangle's second and third vertex;
 * `triangle` is the scene-wide triangle id: Instance.first_triangle + the id within the mesh.
 * Of several hits the least (t, triangle) wins. A miss has triangle = MACULA_NO_TRIANGLE,
 * t = the ray's t_max and u = v = 0. */
typedef struct HitBlock {
    float t[16], u[16], v[16];
    uint triangle[16];
} HitBlock;
MACULA_ASSERT_SIZE(HitBlock, 256);

MACULA_SHARED_END
#endif
