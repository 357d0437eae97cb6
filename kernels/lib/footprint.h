/* Last frame's planes at the places where a strip's pixels were. OpenCL C only. */
#ifndef MACULA_LIB_FOOTPRINT_H
#define MACULA_LIB_FOOTPRINT_H

#include "lib/strip.h"

/* The pixels around each lane's place. Places are counted in 1/256 of a pixel, as texture units do:
 * a place within 1/512 of a pixel's middle is that pixel exactly, so that nothing drifts while the
 * view stands still. */
typedef struct Footprint {
    int width, height;
    Int x, y; /* the pixel before the place */
    Real to_x, to_y;
    int first_x, first_y; /* the least of them */
    bool straight;        /* they lie side by side, so far from the edge that all taps exist */
    bool close; /* or in two rows and less than sixteen columns, as those of most motions do */
    bool exact; /* no place lies between pixels */
} Footprint;

/* x, y: in pixels, 0 being the edge of the image. Lanes that are not `wanted` get any place. */
MACULA_ALWAYS_INLINE Footprint footprint_at(Real x, Real y, Mask wanted, int width, int height) {
    const Real least = splat(-2.0f);
    const Real kept_x = clamped(x, least, splat((float)width + 2.0f));
    const Real kept_y = clamped(y, least, splat((float)height + 2.0f));
    const Int at_x = to_int(rint(fma(kept_x, splat(256.0f), splat(-128.0f))));
    const Int at_y = to_int(rint(fma(kept_y, splat(256.0f), splat(-128.0f))));
    const Int none = splat_int(0x7fffffff), zero = splat_int(0), lanes = strip_lanes();
    const Int column = least_of_lanes(wanted ? at_x >> 8 : none);
    const Int row = least_of_lanes(wanted ? at_y >> 8 : none);
    Footprint f;
    f.width = width;
    f.height = height;
    f.first_x = first_of_lanes(column);
    f.first_y = first_of_lanes(row);
    const Int ahead = (at_x >> 8) - column, below = (at_y >> 8) - row;
    const bool inside = f.first_x >= 1 && f.first_y >= 1 && f.first_x + MACULA_LANES + 2 <= width &&
                        f.first_y + 4 <= height;
    f.straight = inside && !any_lane(wanted & ((ahead != lanes) | (below != zero)));
    f.close = inside && !any_lane(wanted & ((ahead > 15) | (below > 1)));
    f.x = wanted ? at_x >> 8 : (inside ? column : zero);
    f.y = wanted ? at_y >> 8 : (inside ? row : zero);
    const Int part_x = wanted ? at_x & 255 : zero, part_y = wanted ? at_y & 255 : zero;
    f.exact = !any_lane((part_x | part_y) != 0);
    f.to_x = int_to_real(part_x) * splat(0x1p-8f);
    f.to_y = int_to_real(part_y) * splat(0x1p-8f);
    return f;
}

/* The pixel (i, j) after the one before the place. */
MACULA_ALWAYS_INLINE Real tap_of(global const float* plane, const Footprint* f, int i, int j) {
    global const float* first = plane + (f->first_y + j) * f->width + (f->first_x + i);
    if (f->straight)
        return load_reals(first, 0u);
#if MACULA_LANES == 16
    if (f->close) {
        const Int ahead = f->x - f->first_x;
        const Real upper = permuted16(vload16(0, first), ahead);
        const Real lower = permuted16(vload16(0, first + f->width), ahead);
        return f->y != f->first_y ? lower : upper;
    }
#endif
    const Int x = clamp(f->x + i, (Int)(0), (Int)(f->width - 1));
    const Int y = clamp(f->y + j, (Int)(0), (Int)(f->height - 1));
    const Int index = y * f->width + x;
    return MACULA_GATHER(float, plane, index, );
}

/* The pixel that holds the place. */
MACULA_ALWAYS_INLINE Real nearest_tap(global const float* plane, const Footprint* f) {
    const Real middle = tap_of(plane, f, 0, 0);
    if (f->exact)
        return middle;
    const Mask right = f->to_x >= splat(0.5f), below = f->to_y >= splat(0.5f);
    const Real upper = right ? tap_of(plane, f, 1, 0) : middle;
    const Real lower = right ? tap_of(plane, f, 1, 1) : tap_of(plane, f, 0, 1);
    return below ? lower : upper;
}

/* Catmull and Rom's weights for places between the two pixels in the middle of four. */
typedef struct CubicWeights {
    Real w[4];
} CubicWeights;

MACULA_ALWAYS_INLINE CubicWeights cubic_weights_of(Real t) {
    const Real s = splat(1.0f) - t;
    CubicWeights c;
    c.w[0] = splat(-0.5f) * t * (s * s);
    c.w[1] = fma(t * t, fma(t, splat(1.5f), splat(-2.5f)), splat(1.0f));
    c.w[2] = fma(s * s, fma(s, splat(1.5f), splat(-2.5f)), splat(1.0f));
    c.w[3] = splat(-0.5f) * s * (t * t);
    return c;
}

/* A plane between its pixels. */
typedef struct Between {
    Real value; /* cubic, but within what the four pixels around the place span: sharp, since a
                   history is read anew in every frame, and without ringing */
    Real mean;  /* over the three by three pixels around the place */
} Between;

MACULA_ALWAYS_INLINE Between plane_between(global const float* plane, const Footprint* f,
                                           const CubicWeights* across, const CubicWeights* down) {
    Real value = splat(0.0f), sum = splat(0.0f), low = splat(0.0f), high = splat(0.0f);
    for (int j = 0; j < 4; ++j) {
        const Real a = tap_of(plane, f, -1, j - 1), b = tap_of(plane, f, 0, j - 1);
        const Real c = tap_of(plane, f, 1, j - 1), d = tap_of(plane, f, 2, j - 1);
        const Real outer = fma(across->w[0], a, across->w[3] * d);
        const Real row = fma(across->w[1], b, fma(across->w[2], c, outer));
        const Real box = fma(f->to_x, d - a, a) + (b + c);
        value = fma(down->w[j], row, value);
        if (j == 0)
            sum = fma(-f->to_y, box, box);
        else
            sum = j == 3 ? fma(f->to_y, box, sum) : sum + box;
        if (j == 1) {
            low = m_min(b, c);
            high = m_max(b, c);
        }
        if (j == 2) {
            low = m_min(low, m_min(b, c));
            high = m_max(high, m_max(b, c));
        }
    }
    const Between found = {m_min(m_max(value, low), high), sum * splat(NINTH)};
    return found;
}

#endif
