/* The history of sixteen pixels at once: lib/reprojection.h's homography over the cells that a
 * packet of 4 x 4 pixels meets, two or three as a rule. */
#ifndef MACULA_LIB_REPROJECTION_PACKET_H
#define MACULA_LIB_REPROJECTION_PACKET_H

#include "lib/reprojection.h"
#include "lib/simd.h"

/* A triangle of a cell as functions of the place in this view, relative to the cell's first corner:
 * numerators and denominator of the place in the last frame, and the inverse depth. */
typedef struct Homography {
    float3 weight; /* at, per x, per y */
    float3 from_x, from_y;
    float3 inverse_depth;
    float footprint; /* squared length of the longer change for one pixel, texels of last frame */
} Homography;

/* Corners a (the cell's first), b and c (its last); `b_step`: from a to b in the last frame,
 * `step`: from a to c. */
MACULA_ALWAYS_INLINE void make_homography(float4 a, float4 b, float4 c, float2 b_step, float2 step,
                                          Homography* h) {
    const float2 side = b.xy - a.xy, diagonal = c.xy - a.xy;
    const float area = cross2(side, diagonal);
    const float share = fabs(area) > 1e-12f ? m_divide(1.0f, area) : 0.0f;
    const float b_x = diagonal.y * share, b_y = -diagonal.x * share;
    const float c_x = -side.y * share, c_y = side.x * share;
    const float b_more = b.w - a.w, c_more = c.w - a.w;
    h->weight = (float3)(a.w, fma(b_more, b_x, c_more * c_x), fma(b_more, b_y, c_more * c_y));
    const float4 all = (float4)(b_x * b.w, b_y * b.w, c_x * c.w, c_y * c.w);
    h->from_x =
        (float3)(0.0f, fma(all.x, b_step.x, all.z * step.x), fma(all.y, b_step.x, all.w * step.x));
    h->from_y =
        (float3)(0.0f, fma(all.x, b_step.y, all.z * step.y), fma(all.y, b_step.y, all.w * step.y));
    const float b_deep = b.z - a.z, c_deep = c.z - a.z;
    h->inverse_depth =
        (float3)(a.z, fma(b_deep, b_x, c_deep * c_x), fma(b_deep, b_y, c_deep * c_y));
    const float2 per_x =
        (float2)(fma(b_x, b_step.x, c_x * step.x), fma(b_x, b_step.y, c_x * step.y));
    const float2 per_y =
        (float2)(fma(b_y, b_step.x, c_y * step.x), fma(b_y, b_step.y, c_y * step.y));
    h->footprint =
        m_max(fma(per_x.x, per_x.x, per_x.y * per_x.y), fma(per_y.x, per_y.x, per_y.y * per_y.y));
}

/* Results for sixteen pixels; lanes that were not asked for are 0. */
typedef struct HistoryPacket {
    float16 x, y; /* last frame's image, pixels */
    float16 inverse_depth;
    uint wide; /* bit n: the footprint of lane n needs more than four texels */
} HistoryPacket;

MACULA_ALWAYS_INLINE float16 at_lanes(float3 plane, float16 x, float16 y) {
    return fma((float16)(plane.y), x, fma((float16)(plane.z), y, (float16)(plane.x)));
}

MACULA_ALWAYS_INLINE int16 lanes_of(uint bits) {
    return ((int16)((int)bits) >> MACULA_LANES16 & 1) != 0;
}

MACULA_ALWAYS_INLINE uint first_lane(uint bits) {
    return popcount((bits & -bits) - 1u);
}

/* Pixels of a footprint whose squared length is above this are filtered (section 3.2): up to half a
 * texel more than one, four neighbours are filter enough. */
#define MACULA_WIDE_FOOTPRINT 2.25f

/* One cell's share: lanes `inside`, at x, y. */
MACULA_ALWAYS_INLINE void find_in_cell(const MeshTables* mesh, global const WeierParams* weier,
                                       uint cell, uint inside, float16 x, float16 y,
                                       HistoryPacket* history) {
    const uint i = cell & ((1u << weier->cell_bits_x) - 1u), j = cell >> weier->cell_bits_x;
    const uint first = j * weier->support_width + i, below = first + weier->support_width;
    const float4 a = mesh->vertices[first], c = mesh->vertices[below + 1u];
    const float2 from = (float2)(mesh->columns[i], mesh->rows[j]);
    const float2 step = (float2)(mesh->columns[i + 1u], mesh->rows[j + 1u]) - from;
    Homography upper, lower;
    make_homography(a, mesh->vertices[first + 1u], c, (float2)(step.x, 0.0f), step, &upper);
    make_homography(a, mesh->vertices[below], c, (float2)(0.0f, step.y), step, &lower);
    const float16 to_x = x - a.x, to_y = y - a.y;
    /* The triangle on the pixel's side of the diagonal. */
    const int16 above = fma((float16)(c.x - a.x), to_y, -((c.y - a.y) * to_x)) <= 0.0f;
    const float16 weight =
        above ? at_lanes(upper.weight, to_x, to_y) : at_lanes(lower.weight, to_x, to_y);
    const float16 inverse =
        m_divide((float16)(1.0f), fabs(weight) > 1e-12f ? weight : (float16)(1e-12f));
    const float16 part_x =
        above ? at_lanes(upper.from_x, to_x, to_y) : at_lanes(lower.from_x, to_x, to_y);
    const float16 part_y =
        above ? at_lanes(upper.from_y, to_x, to_y) : at_lanes(lower.from_y, to_x, to_y);
    const float16 depth = above ? at_lanes(upper.inverse_depth, to_x, to_y)
                                : at_lanes(lower.inverse_depth, to_x, to_y);
    const int16 lanes = lanes_of(inside);
    /* A pixel of the cell cannot lie outside of it but by rounding. */
    const float16 at_x = clamp(part_x * inverse, (float16)(-0.5f), (float16)(step.x + 0.5f));
    const float16 at_y = clamp(part_y * inverse, (float16)(-0.5f), (float16)(step.y + 0.5f));
    history->x = lanes ? at_x + from.x : history->x;
    history->y = lanes ? at_y + from.y : history->y;
    history->inverse_depth = lanes ? depth : history->inverse_depth;
    history->wide |= m_max(upper.footprint, lower.footprint) > MACULA_WIDE_FOOTPRINT ? inside : 0u;
}

/* The histories of the lanes in `wanted`, whose keys belong to cells. x, y: pixels' middles. */
MACULA_ALWAYS_INLINE void find_histories(const MeshTables* mesh, global const WeierParams* weier,
                                         const uint* keys, uint wanted, float16 x, float16 y,
                                         HistoryPacket* history) {
    history->x = history->y = history->inverse_depth = (float16)(0.0f);
    history->wide = 0u;
    while (wanted != 0u) {
        const uint cell = cell_of_key(keys[first_lane(wanted)], weier);
        uint inside = 0u;
        for (uint lane = 0u; lane < 16u; ++lane)
            inside |= cell_of_key(keys[lane], weier) == cell ? 1u << lane : 0u;
        inside &= wanted;
        find_in_cell(mesh, weier, cell, inside, x, y, history);
        wanted &= ~inside;
    }
}

#endif
