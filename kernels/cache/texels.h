/* Last frame's texels around the histories of sixteen pixels. */
#ifndef MACULA_CACHE_TEXELS_H
#define MACULA_CACHE_TEXELS_H

#include "lib/reprojection_packet.h"

/* The four texels around each place, as indices, and how far it is from the first one. */
typedef struct Texels {
    int16 upper_left, upper_right, lower_left, lower_right;
    int16 nearest;
    float16 to_x, to_y;
} Texels;

/* Places are counted in 1/256 of a pixel, as texture units do: a place within 1/512 of a texel's
 * middle is that texel exactly, so that nothing drifts while the view stands still. */
MACULA_ALWAYS_INLINE void find_texels(const HistoryPacket* history, uint width, uint height,
                                      Texels* t) {
    const int16 x = convert_int16(rint(fma(history->x, (float16)(256.0f), (float16)(-128.0f))));
    const int16 y = convert_int16(rint(fma(history->y, (float16)(256.0f), (float16)(-128.0f))));
    const int16 right = (int16)((int)width - 1), bottom = (int16)((int)height - 1);
    const int16 none = (int16)(0);
    const int16 x0 = min(max(x >> 8, none), right), x1 = min(max((x >> 8) + 1, none), right);
    const int16 y0 = min(max(y >> 8, none), bottom) * (int)width;
    const int16 y1 = min(max((y >> 8) + 1, none), bottom) * (int)width;
    t->upper_left = y0 + x0;
    t->upper_right = y0 + x1;
    t->lower_left = y1 + x0;
    t->lower_right = y1 + x1;
    t->to_x = convert_float16(x & 255) * 0x1p-8f;
    t->to_y = convert_float16(y & 255) * 0x1p-8f;
    t->nearest = ((y & 255) >= 128 ? y1 : y0) + ((x & 255) >= 128 ? x1 : x0);
}

/* The texels of four neighbours of a row are mostly neighbours of a row, too. */
typedef struct Spans {
    uint straight; /* bit n: lane n's texels, and one more each way, lie as its row's first one says
                    */
    int first[4];  /* index of the texel for each row's first lane */
} Spans;

MACULA_ALWAYS_INLINE void find_spans(const Texels* t, int16 known, uint width, uint height,
                                     Spans* spans) {
    const int16 column = MACULA_LANES16 & 3;
    const int16 start = known ? t->upper_left - column : (int16)(0x7fffffff);
    const int16 pairs = min(start, start.s1032547698badcfe);
    const int16 least = min(pairs, pairs.s23016745ab89efcd);
    const int last = (int)(width * height) - 2 * (int)width - 5;
    const int16 whole = (start == least) & (start > (int)width) & (start < last) &
                        (t->upper_right == t->upper_left + 1) &
                        (t->lower_left == t->upper_left + (int)width);
    spans->straight = bits_of_lanes16(whole | ~known);
    vstore4(least.s048c, 0, spans->first);
}

MACULA_ALWAYS_INLINE float16 blend_texels(float16 a, float16 b, float16 c, float16 d, float16 to_x,
                                          float16 to_y) {
    const float16 top = fma(b - a, to_x, a), bottom = fma(d - c, to_x, c);
    return fma(bottom - top, to_y, top);
}

/* Catmull and Rom's weights of four texels for places between the two in the middle. */
typedef struct Cubic {
    float16 before, first, second, after;
} Cubic;

MACULA_ALWAYS_INLINE Cubic cubic_weights16(float16 t) {
    const float16 s = 1.0f - t;
    Cubic w;
    w.before = -0.5f * t * (s * s);
    w.first = fma(t * t, fma(t, (float16)(1.5f), (float16)(-2.5f)), (float16)(1.0f));
    w.second = fma(s * s, fma(s, (float16)(1.5f), (float16)(-2.5f)), (float16)(1.0f));
    w.after = -0.5f * s * (t * t);
    return w;
}

/* Of the four pixels of a row, for each of their four components. */
MACULA_ALWAYS_INLINE float16 spread_row(float16 v, uint row) {
    const float8 half_of = row < 2u ? v.lo : v.hi;
    const float4 r = (row & 1u) == 0u ? half_of.lo : half_of.hi;
    return (float16)(r.xxxx, r.yyyy, r.zzzz, r.wwww);
}

MACULA_ALWAYS_INLINE Cubic spread_weights(const Cubic* w, uint row) {
    const Cubic r = {spread_row(w->before, row), spread_row(w->first, row),
                     spread_row(w->second, row), spread_row(w->after, row)};
    return r;
}

/* Four pixels' texels side by side, from `at` on. */
MACULA_ALWAYS_INLINE float16 cubic_row16(global const float* at, const Cubic* w) {
    const float16 outer = fma(vload16(0, at - 4), w->before, vload16(0, at + 8) * w->after);
    return fma(vload16(0, at), w->first, fma(vload16(0, at + 4), w->second, outer));
}

/* Between four by four texels, but within what the inner four span: sharper than between those
 * alone, since a history is read anew in every frame, and without ringing. */
MACULA_ALWAYS_INLINE float16 cubic_texels16(global const float* at, uint width, const Cubic* x,
                                            const Cubic* y) {
    const uint line = 4u * width;
    const float16 outer =
        fma(cubic_row16(at - line, x), y->before, cubic_row16(at + 2u * line, x) * y->after);
    const float16 value =
        fma(cubic_row16(at, x), y->first, fma(cubic_row16(at + line, x), y->second, outer));
    const float16 a = vload16(0, at), b = vload16(0, at + 4);
    const float16 c = vload16(0, at + line), d = vload16(0, at + line + 4);
    const float16 low = m_min(m_min(a, b), m_min(c, d));
    const float16 high = m_max(m_max(a, b), m_max(c, d));
    return m_min(m_max(value, low), high);
}

MACULA_ALWAYS_INLINE float16 four_texels(global const float4* image, const int* index) {
    return (float16)(image[index[0]], image[index[1]], image[index[2]], image[index[3]]);
}

/* Indices of texels, lane by lane, for where they are scattered. */
typedef struct Lanes {
    int upper_left[16], upper_right[16], lower_left[16], lower_right[16], nearest[16];
    int between[16]; /* not 0 where the place is no texel's middle */
} Lanes;

MACULA_ALWAYS_INLINE void put_lanes(const Texels* texels, Lanes* t) {
    vstore16(texels->upper_left, 0, t->upper_left);
    vstore16(texels->upper_right, 0, t->upper_right);
    vstore16(texels->lower_left, 0, t->lower_left);
    vstore16(texels->lower_right, 0, t->lower_right);
    vstore16(texels->nearest, 0, t->nearest);
    vstore16((texels->to_x != 0.0f) | (texels->to_y != 0.0f), 0, t->between);
}

/* What the rows of a packet share. */
typedef struct Sources {
    Texels texels;
    Spans spans;
    Cubic across, down;
    Lanes lanes;
} Sources;

MACULA_ALWAYS_INLINE void find_sources(const HistoryPacket* history, int16 known, uint width,
                                       uint height, Sources* s) {
    find_texels(history, width, height, &s->texels);
    find_spans(&s->texels, known, width, height, &s->spans);
    s->across = cubic_weights16(s->texels.to_x);
    s->down = cubic_weights16(s->texels.to_y);
    put_lanes(&s->texels, &s->lanes);
}

/* Colours of the four pixels of a row between their texels: four each where these are scattered, or
 * at the image's edge. */
MACULA_ALWAYS_INLINE float16 row_of_colours(global const float4* image, const Sources* s,
                                            uint width, uint row) {
    if ((s->spans.straight >> 4u * row & 15u) == 15u) {
        const Cubic x = spread_weights(&s->across, row), y = spread_weights(&s->down, row);
        return cubic_texels16((global const float*)(image + s->spans.first[row]), width, &x, &y);
    }
    const Lanes* t = &s->lanes;
    return blend_texels(
        four_texels(image, t->upper_left + 4u * row), four_texels(image, t->upper_right + 4u * row),
        four_texels(image, t->lower_left + 4u * row), four_texels(image, t->lower_right + 4u * row),
        spread_row(s->texels.to_x, row), spread_row(s->texels.to_y, row));
}

#endif
