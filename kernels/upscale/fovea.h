/* Where the foveal disk of kernel log-polar foveation lies in a strip. OpenCL C only. */
#ifndef MACULA_UPSCALE_FOVEA_H
#define MACULA_UPSCALE_FOVEA_H

#include "lib/log_polar.h"
#include "lib/strip.h"

/* From the gaze, in pixels that are rendered: of a strip that is, and of one of the picture. */
MACULA_ALWAYS_INLINE Real distance_in_picture(global const Fovea* fovea, const Strip* s,
                                              float across, float down) {
    const Real x = fma(strip_middles(s), splat(across), splat(-fovea->x));
    const float y = fma((float)s->y + 0.5f, down, -fovea->y);
    return m_sqrt(fma(x, x, splat(y * y)));
}

MACULA_ALWAYS_INLINE Real distance_to_gaze(global const Fovea* fovea, const Strip* s) {
    return distance_in_picture(fovea, s, 1.0f, 1.0f);
}

/* No pixel of the strip lies within `reach` of the gaze. What is asked first of strips, most of
 * which have nothing to do with the disk. */
MACULA_ALWAYS_INLINE bool is_far_from_gaze(global const Fovea* fovea, const Strip* s, float across,
                                           float down, float reach) {
    const float left = fma((float)s->x, across, -fovea->x);
    const float right = fma((float)(s->x + MACULA_LANES), across, -fovea->x);
    const float x = left > 0.0f ? left : (right < 0.0f ? right : 0.0f);
    const float y = fma((float)s->y + 0.5f, down, -fovea->y);
    const float kept = reach + 1.0f;
    return fma(x, x, y * y) > kept * kept;
}

/* Places of the picture that lay in the disk: pixels around them were gathered, too. */
MACULA_ALWAYS_INLINE Mask was_gathered(global const Fovea* fovea, Real x, Real y, float across,
                                       float down) {
    const Real dx = fma(x, splat(across), splat(-fovea->x));
    const Real dy = fma(y, splat(down), splat(-fovea->y));
    return m_sqrt(fma(dx, dx, dy * dy)) < splat(fovea->radius);
}

#endif
