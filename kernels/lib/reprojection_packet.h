/* The history of sixteen pixels at once: lib/reprojection.h's homography over the cells that a
 * packet of 4 x 4 pixels meets, three or four as a rule. */
#ifndef MACULA_LIB_REPROJECTION_PACKET_H
#define MACULA_LIB_REPROJECTION_PACKET_H

#include "lib/mesh_cells.h"
#include "lib/reprojection.h"
#include "lib/simd.h"

/* The cells of lib/mesh_cells.h, and the places of their corners in the last frame, pixels. */
typedef struct CellTables {
    global const float* cells;
    global const float *columns, *rows;
} CellTables;

/* Results for sixteen pixels; lanes that were not asked for are 0 or another one's. */
typedef struct HistoryPacket {
    float16 x, y; /* last frame's image, pixels */
    float16 inverse_depth;
    uint wide; /* bit n: the footprint of lane n needs more than four texels */
} HistoryPacket;

MACULA_ALWAYS_INLINE int16 lanes_of(uint bits) {
    return ((int16)((int)bits) >> MACULA_LANES16 & 1) != 0;
}

/* Pixels of a footprint whose squared length is above this are filtered (section 3.2): up to half a
 * texel more than one, four neighbours are filter enough. */
#define MACULA_WIDE_FOOTPRINT 2.25f

/* A function over a triangle of the cell. */
MACULA_ALWAYS_INLINE float16 over_triangle(global const float* cell, uint field, float at,
                                           float16 x, float16 y) {
    return fma((float16)(cell[field * 16u]), x,
               fma((float16)(cell[(field + 1u) * 16u]), y, (float16)(at)));
}

MACULA_ALWAYS_INLINE float16 over_cell(global const float* cell, uint field, float at, int16 above,
                                       float16 x, float16 y) {
    const float16 upper = over_triangle(cell, MACULA_CELL_UPPER + field, at, x, y);
    const float16 lower = over_triangle(cell, MACULA_CELL_LOWER + field, at, x, y);
    return above ? upper : lower;
}

MACULA_ALWAYS_INLINE float16 within(float16 v, float low, float16 high) {
    v = v < low ? (float16)(low) : v;
    return v > high ? high : v;
}

/* The homographies of sixteen pixels, before the division: a place is `from` + `part` / `ratio`. */
typedef struct Homographies {
    float16 ratio, part_x, part_y, from_x, from_y;
    float16 most_x, most_y; /* of part / ratio */
    float16 inverse_depth;
    uint wide;
} Homographies;

/* One cell's share: lanes `inside`, which are `bits`, at x, y. */
MACULA_ALWAYS_INLINE void find_in_cell(const CellTables* mesh, global const WeierParams* weier,
                                       uint number, int16 inside, uint bits, float16 x, float16 y,
                                       Homographies* found) {
    const uint i = number & ((1u << weier->cell_bits_x) - 1u), j = number >> weier->cell_bits_x;
    const uint block = j * cell_blocks_across(weier->support_width) + i / MACULA_CELL_LANES;
    global const float* cell =
        mesh->cells + block * (MACULA_CELL_FIELDS * MACULA_CELL_LANES) + i % MACULA_CELL_LANES;
    const float2 from = (float2)(mesh->columns[i], mesh->rows[j]);
    const float2 step = (float2)(mesh->columns[i + 1u], mesh->rows[j + 1u]) - from;
    const float16 to_x = x - cell[MACULA_CELL_X * 16u], to_y = y - cell[MACULA_CELL_Y * 16u];
    /* The triangle on the pixel's side of the diagonal. */
    const int16 above = fma((float16)(cell[MACULA_CELL_DIAGONAL_X * 16u]), to_y,
                            -(cell[MACULA_CELL_DIAGONAL_Y * 16u] * to_x)) <= 0.0f;
    const float16 ratio =
        over_cell(cell, MACULA_PER_PIXEL_RATIO, cell[MACULA_CELL_RATIO * 16u], above, to_x, to_y);
    const float16 part_x = over_cell(cell, MACULA_PER_PIXEL_FROM_X, 0.0f, above, to_x, to_y);
    const float16 part_y = over_cell(cell, MACULA_PER_PIXEL_FROM_Y, 0.0f, above, to_x, to_y);
    const float16 depth =
        over_cell(cell, MACULA_PER_PIXEL_DEPTH, cell[MACULA_CELL_DEPTH * 16u], above, to_x, to_y);
    found->ratio = inside ? ratio : found->ratio;
    found->part_x = inside ? part_x : found->part_x;
    found->part_y = inside ? part_y : found->part_y;
    found->from_x = inside ? (float16)(from.x) : found->from_x;
    found->from_y = inside ? (float16)(from.y) : found->from_y;
    found->most_x = inside ? (float16)(step.x + 0.5f) : found->most_x;
    found->most_y = inside ? (float16)(step.y + 0.5f) : found->most_y;
    found->inverse_depth = inside ? depth : found->inverse_depth;
    found->wide |= cell[MACULA_CELL_FOOTPRINT * 16u] > MACULA_WIDE_FOOTPRINT ? bits : 0u;
}

/* The histories of the lanes in `wanted`, whose keys belong to cells. x, y: pixels' middles. */
MACULA_ALWAYS_INLINE void find_histories(const CellTables* mesh, global const WeierParams* weier,
                                         uint16 keys, uint wanted, float16 x, float16 y,
                                         HistoryPacket* history) {
    const uint16 numbers = keys >> 1 & ((1u << (weier->cell_bits_x + weier->cell_bits_y)) - 1u);
    uint number[16];
    vstore16(numbers, 0, number);
    const float16 none = (float16)(0.0f);
    Homographies found = {(float16)(1.0f), none, none, none, none, none, none, none, 0u};
    while (wanted != 0u) {
        const uint cell = number[first_lane(wanted)];
        const int16 inside = numbers == cell;
        const uint bits = bits_of_lanes16(inside) & wanted;
        find_in_cell(mesh, weier, cell, inside, bits, x, y, &found);
        wanted &= ~bits;
    }
    const float16 ratio = fabs(found.ratio) > 1e-12f ? found.ratio : (float16)(1e-12f);
    const float16 inverse = m_divide((float16)(1.0f), ratio);
    /* A pixel of the cell cannot lie outside of it but by rounding. */
    history->x = within(found.part_x * inverse, -0.5f, found.most_x) + found.from_x;
    history->y = within(found.part_y * inverse, -0.5f, found.most_y) + found.from_y;
    history->inverse_depth = found.inverse_depth;
    history->wide = found.wide;
}

#endif
