/* What moved since the last frame. An object's support samples move with it: motion number k of a
 * sample is 0 where it stands still, else row k - 1 of a table of matrices. */
#ifndef MACULA_REPROJECT_MOTION_H
#define MACULA_REPROJECT_MOTION_H

#include "lib/simd.h"
#include "lib/vector16.h"
#include "shared/ray.h"
#include "shared/weier.h"

typedef struct Motions {
    uint moved; /* instances that moved; where it is 0, nothing else is looked at */
    uint count;
    global const InstanceMotion* instances;
    global const float* matrices; /* 3 x 4: this frame's world from the last one's */
} Motions;

/* The motion number of what has a scene-wide triangle id. */
static inline uint motion_of_triangle(const Motions* motions, uint triangle) {
    if (triangle == MACULA_NO_TRIANGLE)
        return 0u;
    uint low = 0u, high = motions->count;
    while (low + 1u < high) {
        const uint middle = (low + high) / 2u;
        const bool before = motions->instances[middle].first_triangle <= triangle;
        low = before ? middle : low;
        high = before ? high : middle;
    }
    return motions->instances[low].motion;
}

/* Points `view` from the camera at `now`: those whose motion is not 0 were at `ray` * `depth` from
 * the camera at `past` before they moved. */
MACULA_ALWAYS_INLINE void move_views(const Motions* motions, uint16 motion, const Vector16* ray,
                                     float16 depth, float3 past, float3 now, Vector16* view) {
    uint numbers[16];
    float m[12][16];
    vstore16(motion, 0, numbers);
    for (uint lane = 0u; lane < 16u; ++lane) {
        global const float* matrix = motions->matrices + 12u * (max(numbers[lane], 1u) - 1u);
        for (uint k = 0u; k < 12u; ++k)
            m[k][lane] = matrix[k];
    }
    float16 moved[3];
    for (uint row = 0u; row < 3u; ++row) {
        const float16 x = vload16(0, m[4u * row]), y = vload16(0, m[4u * row + 1u]);
        const float16 z = vload16(0, m[4u * row + 2u]), shift = vload16(0, m[4u * row + 3u]);
        const float16 origin =
            fma(x, (float16)(past.x), fma(y, (float16)(past.y), fma(z, (float16)(past.z), shift)));
        const float16 turned = fma(x, ray->x, fma(y, ray->y, z * ray->z));
        moved[row] = fma(turned, depth,
                         origin - (float16)(row == 0u ? now.x : (row == 1u ? now.y : now.z)));
    }
    view->x = motion != 0u ? moved[0] : view->x;
    view->y = motion != 0u ? moved[1] : view->y;
    view->z = motion != 0u ? moved[2] : view->z;
}

#endif
