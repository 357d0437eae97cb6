/* The coarse mesh of last frame's support G-buffer in this frame's view (Weier et al. 2016, section
 * 3.2). Vertices are the support samples; a cell is the quad between four of them, cut along the
 * diagonal from its first to its last corner.
 *
 * A vertex is float4 (x, y, 1 / depth, ratio): its place in this view in pixels, the inverse of its
 * depth, and last frame's depth over this one's; 1 / depth < 0 where it is not in front of the
 * camera. Over a triangle 1 / depth and ratio times a place in the last frame, each divided by the
 * interpolated ratio, are linear on the screen: a homography, so that a view that did not move maps
 * every pixel to itself.
 *
 * A key is what the depth test keeps the least of: from the upper bits on a rank of the depth, the
 * cell, and one bit that asks for a new sample. */
#ifndef MACULA_LIB_REPROJECTION_H
#define MACULA_LIB_REPROJECTION_H

#include "lib/vector.h"
#include "shared/surface.h"
#include "shared/weier.h"

/* Depths from 2^-12 to 2^20 world units are told apart, by the bits of their inverse. */
#define MACULA_LEAST_INVERSE_DEPTH 0x1p-20f
#define MACULA_GREATEST_INVERSE_DEPTH 0x1.fffffep+11f

/* The rank of the depth in the upper bits; 0 is nearest. The last one, all ones, is left to cells
 * that are drawn behind everything else. */
MACULA_ALWAYS_INLINE uint depth_rank(float inverse_depth, uint depth_bits) {
    const float kept =
        clamped(inverse_depth, MACULA_LEAST_INVERSE_DEPTH, MACULA_GREATEST_INVERSE_DEPTH);
    const uint steps = (as_uint(kept) - as_uint(MACULA_LEAST_INVERSE_DEPTH)) >> (28u - depth_bits);
    const uint last = (1u << depth_bits) - 1u;
    return steps == 0u ? last - 1u : last - steps;
}

MACULA_ALWAYS_INLINE uint cell_of_key(uint key, global const WeierParams* weier) {
    return (key >> 1) & ((1u << (weier->cell_bits_x + weier->cell_bits_y)) - 1u);
}

/* Where a pixel lies among the support samples of its row or column, which reach from the first
 * pixel to the last: sample i is at i + 0.5. */
MACULA_ALWAYS_INLINE float place_in_support(uint pixel, uint pixels, uint samples) {
    return fma((float)pixel, m_divide((float)(samples - 1u), (float)(pixels - 1u)), 0.5f);
}

MACULA_ALWAYS_INLINE float cross2(float2 a, float2 b) {
    return fma(a.x, b.y, -(a.y * b.x));
}

/* Where a pixel's history lies. */
typedef struct History {
    float2 at;           /* last frame's image, pixels */
    float2 per_x, per_y; /* change of `at` for one pixel of this view */
    float inverse_depth; /* of the mesh in this view */
    bool found;
} History;

typedef struct MeshTables {
    global const float4* vertices;
    global const float *columns, *rows; /* places of the support samples, pixels */
} MeshTables;

/* The support sample's place along one axis; the outermost lie on the image's edge. */
MACULA_ALWAYS_INLINE History find_history(const MeshTables* mesh, global const WeierParams* weier,
                                          uint key, float x, float y) {
    const uint cell = cell_of_key(key, weier);
    const uint i = cell & ((1u << weier->cell_bits_x) - 1u), j = cell >> weier->cell_bits_x;
    const uint first = j * weier->support_width + i, last = first + weier->support_width + 1u;
    const float4 a = mesh->vertices[first], c = mesh->vertices[last];
    const float2 p = (float2)(x, y) - a.xy, diagonal = c.xy - a.xy;
    /* The triangle on p's side of the diagonal: along the upper or along the left edge. */
    const bool upper = cross2(diagonal, p) <= 0.0f;
    const float4 b = mesh->vertices[upper ? first + 1u : last - 1u];
    const float2 side = b.xy - a.xy;
    const float area = cross2(side, diagonal);
    const float weight_b = cross2(p, diagonal), weight_c = cross2(side, p);
    const float weight_a = (area - weight_b) - weight_c;
    const float share_b = weight_b * b.w, share_c = weight_c * c.w;
    const float sum = fma(weight_a, a.w, share_b + share_c);
    const float2 from = (float2)(mesh->columns[i], mesh->rows[j]);
    const float2 step = (float2)(mesh->columns[i + 1u], mesh->rows[j + 1u]) - from;
    const float2 part =
        (float2)(upper ? share_b + share_c : share_c, upper ? share_c : share_b + share_c);
    History history;
    history.found = fabs(sum) > 1e-12f && fabs(area) > 1e-12f;
    const float inverse = history.found ? m_divide(1.0f, sum) : 0.0f;
    history.at = fma(step * part, (float2)(inverse), from);
    const float share = history.found ? m_divide(1.0f, area) : 0.0f;
    history.inverse_depth = fma(weight_a, a.z, fma(weight_b, b.z, weight_c * c.z)) * share;
    /* The triangle's affine map is close enough for the size of a footprint. */
    const float2 by_b = (float2)(diagonal.y, -diagonal.x) * share;
    const float2 by_c = (float2)(-side.y, side.x) * share;
    const float2 along_b = upper ? (float2)(step.x, 0.0f) : (float2)(0.0f, step.y);
    history.per_x = fma(along_b, (float2)(by_b.x), step * by_c.x);
    history.per_y = fma(along_b, (float2)(by_b.y), step * by_c.y);
    history.found = history.found && history.at.x > from.x - 1.0f && history.at.y > from.y - 1.0f &&
                    history.at.x < from.x + step.x + 1.0f && history.at.y < from.y + step.y + 1.0f;
    return history;
}

/* Finite: neither infinite nor not a number. */
MACULA_ALWAYS_INLINE bool is_finite3(float3 v) {
    return fabs(v.x) < 1e30f && fabs(v.y) < 1e30f && fabs(v.z) < 1e30f;
}

MACULA_ALWAYS_INLINE uint texel_index(int x, int y, uint width, uint height) {
    const int column = clamp(x, 0, (int)width - 1), row = clamp(y, 0, (int)height - 1);
    return (uint)row * width + (uint)column;
}

/* A place in 1/256 of a pixel, as texture units count: a place within 1/512 of a texel's middle is
 * that texel exactly, so that nothing drifts while the view stands still. */
typedef struct Footing {
    int x, y;         /* the upper left of the four texels around the place */
    float to_x, to_y; /* part of the way to the next, a multiple of 1/256 */
} Footing;

MACULA_ALWAYS_INLINE Footing footing_at(float2 at) {
    const int x = (int)rint(fma(at.x, 256.0f, -128.0f));
    const int y = (int)rint(fma(at.y, 256.0f, -128.0f));
    Footing f;
    f.x = x >> 8;
    f.y = y >> 8;
    f.to_x = (float)(x & 255) * 0x1p-8f;
    f.to_y = (float)(y & 255) * 0x1p-8f;
    return f;
}

MACULA_ALWAYS_INLINE float4 bilinear4(global const float4* image, uint width, uint height,
                                      const Footing* f) {
    const float4 a = image[texel_index(f->x, f->y, width, height)];
    if (f->to_x == 0.0f && f->to_y == 0.0f)
        return a;
    const float4 b = image[texel_index(f->x + 1, f->y, width, height)];
    const float4 c = image[texel_index(f->x, f->y + 1, width, height)];
    const float4 d = image[texel_index(f->x + 1, f->y + 1, width, height)];
    const float4 top = fma(b - a, (float4)(f->to_x), a);
    const float4 bottom = fma(d - c, (float4)(f->to_x), c);
    return fma(bottom - top, (float4)(f->to_y), top);
}

#endif
