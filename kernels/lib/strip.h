/* Images as planes of one float a pixel, and strips of them: a work-item's lanes are neighbours in
 * a row. What they read is then mostly one vector. OpenCL C only. */
#ifndef MACULA_LIB_STRIP_H
#define MACULA_LIB_STRIP_H

#include "lib/lane_memory.h"

#define NINTH 0x1.c71c72p-4f /* of a sum over three by three pixels */

typedef struct Strip {
    int width, height; /* of the image */
    int x, y;          /* of the first lane */
} Strip;

/* The strip of a work-item; y >= height beyond the last one. */
static inline Strip strip_of_item(uint width, uint height) {
    const uint across = (width + MACULA_LANES - 1u) / MACULA_LANES, item = (uint)get_global_id(0);
    Strip s;
    s.width = (int)width;
    s.height = (int)height;
    s.x = (int)(item % across * MACULA_LANES);
    s.y = (int)(item / across);
    return s;
}

#if MACULA_LANES == 1
MACULA_ALWAYS_INLINE Int strip_lanes(void) {
    return 0;
}
MACULA_ALWAYS_INLINE Int least_of_lanes(Int v) {
    return v;
}
MACULA_ALWAYS_INLINE int first_of_lanes(Int v) {
    return v;
}
MACULA_ALWAYS_INLINE Real int_to_real(Int v) {
    return (float)v;
}
MACULA_ALWAYS_INLINE Mask splat_mask(bool b) {
    return b;
}
#else
MACULA_ALWAYS_INLINE Int strip_lanes(void) {
    return MACULA_LANES16;
}
MACULA_ALWAYS_INLINE Int least_of_lanes(Int v) {
    const int8 a = min(v.lo, v.hi);
    const int4 b = min(a.lo, a.hi);
    const int2 c = min(b.lo, b.hi);
    return (int16)(min(c.x, c.y));
}
MACULA_ALWAYS_INLINE int first_of_lanes(Int v) {
    return v.s0;
}
MACULA_ALWAYS_INLINE Real int_to_real(Int v) {
    return convert_float16(v);
}
MACULA_ALWAYS_INLINE Mask splat_mask(bool b) {
    return (int16)(b ? -1 : 0);
}
#endif

MACULA_ALWAYS_INLINE Int strip_columns(const Strip* s) {
    return s->x + strip_lanes();
}

/* The middles of the strip's pixels. */
MACULA_ALWAYS_INLINE Real strip_middles(const Strip* s) {
    return int_to_real(strip_columns(s)) + 0.5f;
}

MACULA_ALWAYS_INLINE Mask strip_inside(const Strip* s) {
    return strip_columns(s) < s->width;
}

MACULA_ALWAYS_INLINE bool is_whole(const Strip* s, int x) {
    return x >= 0 && x + MACULA_LANES <= s->width;
}

/* A plane's pixels from (x + dx, y + dy) on; beyond the edge its outermost ones go on. */
MACULA_ALWAYS_INLINE Real plane_at(global const float* plane, const Strip* s, int dx, int dy) {
    global const float* row = plane + clamp(s->y + dy, 0, s->height - 1) * s->width;
    const int x = s->x + dx;
    if (is_whole(s, x))
        return load_reals(row, (uint)x);
    const Int i = clamp(x + strip_lanes(), (Int)(0), (Int)(s->width - 1));
    return MACULA_GATHER(float, row, i, );
}

MACULA_ALWAYS_INLINE void store_plane(global float* plane, const Strip* s, Real value) {
    global float* row = plane + s->y * s->width;
    if (is_whole(s, s->x))
        store_reals(row, (uint)s->x, value);
    else
        scatter_reals(row, int_to_uint(strip_columns(s)), strip_inside(s), value);
}

/* The same for four floats a pixel. */
MACULA_ALWAYS_INLINE Lane4 colours_at(global const float4* image, const Strip* s, int dx, int dy) {
    global const float4* row = image + clamp(s->y + dy, 0, s->height - 1) * s->width;
    const int x = s->x + dx;
    if (is_whole(s, x))
        return load4(row, (uint)x);
    return gather4(row, int_to_uint(clamp(x + strip_lanes(), (Int)(0), (Int)(s->width - 1))));
}

/* `weight`: the fourth float. */
MACULA_ALWAYS_INLINE void store_weighed(global float4* image, const Strip* s, Real3 colour,
                                        Real weight) {
    global float4* row = image + s->y * s->width;
    if (is_whole(s, s->x))
        store4(row, (uint)s->x, colour, weight);
    else
        scatter4(row, int_to_uint(strip_columns(s)), strip_inside(s), colour, weight);
}

MACULA_ALWAYS_INLINE void store_colours(global float4* image, const Strip* s, Real3 colour) {
    store_weighed(image, s, colour, splat(1.0f));
}

MACULA_ALWAYS_INLINE Real luminance_of(Real3 c) {
    return fma(c.x, splat(0.2126f), fma(c.y, splat(0.7152f), c.z * splat(0.0722f)));
}

#endif
