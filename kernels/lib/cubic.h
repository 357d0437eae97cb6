/* Catmull and Rom's cubic, which keeps the samples themselves. */
#ifndef MACULA_LIB_CUBIC_H
#define MACULA_LIB_CUBIC_H

#include "shared/language.h"

/* Weights of four neighbours for a place t in [0, 1) after the second one. */
static inline float4 cubic_weights(float t) {
    const float s = 1.0f - t;
    return (float4)(-0.5f * t * s * s, fma(t * t, fma(1.5f, t, -2.5f), 1.0f),
                    fma(s * s, fma(1.5f, s, -2.5f), 1.0f), -0.5f * s * t * t);
}

static inline float4 cubic_row(global const float4* row, int x, int last, float4 w) {
    const float4 a = row[clamp(x - 1, 0, last)], b = row[clamp(x, 0, last)];
    const float4 c = row[clamp(x + 1, 0, last)], d = row[clamp(x + 2, 0, last)];
    return fma((float4)(w.x), a, fma((float4)(w.y), b, fma((float4)(w.z), c, w.w * d)));
}

/* The image at (to_x, to_y) in [0, 1) after the middle of its pixel (i, j); beyond the edge its
 * outermost pixels go on. The cubic's overshoot below 0 is cut off. */
static inline float4 cubic_at(global const float4* image, uint width, uint height, int i, int j,
                              float to_x, float to_y) {
    const float4 wx = cubic_weights(to_x), wy = cubic_weights(to_y);
    const int last = (int)width - 1, bottom = (int)height - 1;
    float4 rows[4];
    for (int k = 0; k < 4; ++k)
        rows[k] = cubic_row(image + (uint)clamp(j + k - 1, 0, bottom) * width, i, last, wx);
    const float4 sum =
        fma((float4)(wy.x), rows[0],
            fma((float4)(wy.y), rows[1], fma((float4)(wy.z), rows[2], wy.w * rows[3])));
    return sum > 0.0f ? sum : (float4)(0.0f);
}

#endif
