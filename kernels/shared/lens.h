/* The lens of a head-mounted display: an image is warped beforehand, so that the lens shows it as
 * it was rendered. Each colour has a radial polynomial of its own. */
#ifndef MACULA_SHARED_LENS_H
#define MACULA_SHARED_LENS_H

#include "shared/language.h"

MACULA_SHARED_BEGIN

#define MACULA_LENS_TERMS 8u

/* A point (x, y) of the panel, in pixels, lies at the tangents s = (fma(x, step_x, -left), fma(y,
 * -step_y, up)) from the view axis, before the lens. The lens shows it at s * (1 + g), g = k0 r^2 +
 * k1 r^4 + ..., so the panel shows there what was rendered at the pixel
 * (fma(x, scale_x, shift_x) + per_x s.x g, fma(y, scale_y, shift_y) - per_y s.y g). */
typedef struct LensParams {
    float left, up, step_x, step_y;
    float scale_x, shift_x, scale_y, shift_y;
    float per_x, per_y; /* rendered pixels for a tangent */
    float most[3];      /* r^2 from which on a colour's polynomial turns back */
    float k[3 * 8];     /* red, green, blue */
    uint pad;
} LensParams;
MACULA_ASSERT_SIZE(LensParams, 152);

MACULA_SHARED_END
#endif
