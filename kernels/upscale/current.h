/* What this frame says of a strip of the picture: the samples around its pixels. OpenCL C only. */
#ifndef MACULA_UPSCALE_CURRENT_H
#define MACULA_UPSCALE_CURRENT_H

#include "lib/strip.h"

/* Which rendered pixels are the nearest to a strip of the picture. */
typedef struct Source {
    int width, height; /* that are rendered */
    Int x, y;
    Real to_x, to_y; /* from the nearest sample to the picture's pixel, in rendered pixels */
    int first_x, first_y;
    bool straight; /* all in one row, and less than sixteen apart */
} Source;

/* `across`, `down`: rendered pixels for a pixel of the picture; jitter_x, jitter_y: of the samples.
 */
MACULA_ALWAYS_INLINE Source source_of(const Strip* s, int width, int height, float across,
                                      float down, Real jitter_x, Real jitter_y) {
    const Real x = fma(strip_middles(s), splat(across), splat(-0.5f)) - jitter_x;
    const Real y = splat(fma((float)s->y + 0.5f, down, -0.5f)) - jitter_y;
    const Real column = rint(x), row = rint(y);
    Source source;
    source.width = width;
    source.height = height;
    source.x = to_int(column);
    source.y = to_int(row);
    source.to_x = x - column;
    source.to_y = y - row;
    source.first_x = first_of_lanes(source.x);
    source.first_y = first_of_lanes(source.y);
    const Int lane = source.x - source.first_x;
    source.straight = !any_lane(((lane & 15) != lane) | (source.y != source.first_y));
    return source;
}

/* The plane at the pixel (i, j) after the nearest one. */
MACULA_ALWAYS_INLINE Real source_at(global const float* plane, const Source* s, int i, int j) {
#if MACULA_LANES == 16
    const int x = s->first_x + i;
    if (s->straight && x >= 0 && x + 16 <= s->width) {
        const int y = clamp(s->first_y + j, 0, s->height - 1);
        return permuted16(vload16(0, plane + y * s->width + x), s->x - s->first_x);
    }
#endif
    const Int column = clamp(s->x + i, (Int)(0), (Int)(s->width - 1));
    const Int row = clamp(s->y + j, (Int)(0), (Int)(s->height - 1));
    const Int index = row * s->width + column;
    return MACULA_GATHER(float, plane, index, );
}

/* Weights of three neighbours for a place in [-0.5, 0.5] from the middle one, of a quadratic that
 * keeps the samples themselves (Dodgson 1997). */
typedef struct Weights3 {
    Real w[3];
} Weights3;

MACULA_ALWAYS_INLINE Weights3 quadratic_weights(Real t) {
    const Real size = fabs(t), square = t * t;
    Weights3 q;
    /* At the distances 1 + |t| and 1 - |t|: x^2 - 2.5 x + 1.5. */
    const Real before = fma(splat(-0.5f), size, square), after = fma(splat(0.5f), size, square);
    q.w[1] = fma(splat(-2.0f), square, splat(1.0f));
    q.w[0] = t > splat(0.0f) ? before : after;
    q.w[2] = t > splat(0.0f) ? after : before;
    return q;
}

/* Of a tent over a pixel of the picture and its neighbours; `scale`: pixels of the picture for a
 * rendered one. */
MACULA_ALWAYS_INLINE Weights3 tent_weights(Real t, float scale) {
    Weights3 q;
    for (int i = 0; i < 3; ++i) {
        const Real far = fabs((splat((float)(i - 1)) - t) * splat(scale));
        q.w[i] = m_max(splat(1.0f) - far, splat(0.0f));
    }
    return q;
}

#endif
