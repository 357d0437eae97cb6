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

MACULA_ALWAYS_INLINE float16 within(float16 v, float low, float high) {
    v = v < low ? (float16)(low) : v;
    return v > high ? (float16)(high) : v;
}

/* One cell's share: lanes `inside`, which are `bits`, at x, y. */
MACULA_ALWAYS_INLINE void find_in_cell(const CellTables* mesh, global const WeierParams* weier,
                                       uint number, int16 inside, uint bits, float16 x, float16 y,
                                       HistoryPacket* history) {
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
    const float16 inverse =
        m_divide((float16)(1.0f), fabs(ratio) > 1e-12f ? ratio : (float16)(1e-12f));
    const float16 part_x = over_cell(cell, MACULA_PER_PIXEL_FROM_X, 0.0f, above, to_x, to_y);
    const float16 part_y = over_cell(cell, MACULA_PER_PIXEL_FROM_Y, 0.0f, above, to_x, to_y);
    const float16 depth =
        over_cell(cell, MACULA_PER_PIXEL_DEPTH, cell[MACULA_CELL_DEPTH * 16u], above, to_x, to_y);
    /* A pixel of the cell cannot lie outside of it but by rounding. */
    const float16 at_x = within(part_x * inverse, -0.5f, step.x + 0.5f);
    const float16 at_y = within(part_y * inverse, -0.5f, step.y + 0.5f);
    history->x = inside ? at_x + from.x : history->x;
    history->y = inside ? at_y + from.y : history->y;
    history->inverse_depth = inside ? depth : history->inverse_depth;
    history->wide |= cell[MACULA_CELL_FOOTPRINT * 16u] > MACULA_WIDE_FOOTPRINT ? bits : 0u;
}

/* The histories of the lanes in `wanted`, whose keys belong to cells. x, y: pixels' middles. */
MACULA_ALWAYS_INLINE void find_histories(const CellTables* mesh, global const WeierParams* weier,
                                         uint16 keys, uint wanted, float16 x, float16 y,
                                         HistoryPacket* history) {
    const uint16 numbers = keys >> 1 & ((1u << (weier->cell_bits_x + weier->cell_bits_y)) - 1u);
    uint number[16];
    vstore16(numbers, 0, number);
    history->x = history->y = history->inverse_depth = (float16)(0.0f);
    history->wide = 0u;
    while (wanted != 0u) {
        const uint cell = number[first_lane(wanted)];
        const int16 inside = numbers == cell;
        const uint bits = bits_of_lanes16(inside) & wanted;
        find_in_cell(mesh, weier, cell, inside, bits, x, y, history);
        wanted &= ~bits;
    }
}

#endif
