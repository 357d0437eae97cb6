/* The mesh at full resolution (Weier et al. 2016, section 3.2). Which cell a pixel belongs to is
 * decided by an integer minimum over the keys of lib/reprojection.h. A tile of the screen is one
 * work-item's: no atomics, and no order of execution that could show. */
#include "lib/mesh_cells.h"
#include "lib/reprojection.h"
#include "lib/simd.h"

/* Pixels next to a cell that still count as its own, as a part of it, so that rounding leaves no
 * gap. */
#define OVERLAP 0.002f

typedef struct Tile {
    int left, top, right, bottom; /* pixels, ends excluded; an even number of rows */
} Tile;

MACULA_ALWAYS_INLINE uint16 ranks(float16 inverse_depth, uint depth_bits) {
    const float16 least = (float16)(MACULA_LEAST_INVERSE_DEPTH);
    const float16 most = (float16)(MACULA_GREATEST_INVERSE_DEPTH);
    const float16 kept = m_min(m_max(inverse_depth, least), most);
    const uint16 steps =
        (as_uint16(kept) - as_uint(MACULA_LEAST_INVERSE_DEPTH)) >> (28u - depth_bits);
    const uint last = (1u << depth_bits) - 1u;
    return steps == 0u ? (uint16)(last - 1u) : last - steps;
}

/* A triangle's function at places relative to the cell's first corner. */
MACULA_ALWAYS_INLINE float16 over_triangle(global const float* cell, uint field, float16 x,
                                           float16 y, float at) {
    return fma((float16)(cell[field * 16u]), x,
               fma((float16)(cell[(field + 1u) * 16u]), y, (float16)(at)));
}

MACULA_ALWAYS_INLINE int16 inside_triangle(float16 b, float16 c) {
    return (b >= -OVERLAP) & (c >= -OVERLAP) & (b + c <= 1.0f + OVERLAP);
}

/* Eight pixels of two rows a step: lanes 0 to 7 lie above the others. x to x + 7 and the rows from
 * the even `top` on must lie in the tile. */
MACULA_ALWAYS_INLINE void draw_columns(global const float* cell, uint depth_bits, uint pitch, int x,
                                       int top, int bottom, global uint* keys) {
    const float16 to_x =
        (convert_float16((int16)(x) + (MACULA_LANES16 & 7)) + 0.5f) - cell[MACULA_OUTLINE_X * 16u];
    const float16 below = convert_float16(MACULA_LANES16 >> 3) + 0.5f;
    const float origin_y = cell[MACULA_OUTLINE_Y * 16u], depth = cell[MACULA_OUTLINE_DEPTH * 16u];
    const uint place = as_uint(cell[MACULA_OUTLINE_KEY * 16u]), shift = 32u - depth_bits;
    const uint upper = MACULA_OUTLINE_UPPER, lower = MACULA_OUTLINE_LOWER;
    for (int y = top; y < bottom; y += 2) {
        const float16 to_y = ((float)y + below) - origin_y;
        const int16 in_upper =
            inside_triangle(over_triangle(cell, upper + MACULA_PER_PIXEL_B, to_x, to_y, 0.0f),
                            over_triangle(cell, upper + MACULA_PER_PIXEL_C, to_x, to_y, 0.0f));
        const int16 in_lower =
            inside_triangle(over_triangle(cell, lower + MACULA_PER_PIXEL_B, to_x, to_y, 0.0f),
                            over_triangle(cell, lower + MACULA_PER_PIXEL_C, to_x, to_y, 0.0f));
        const float16 upper_depth =
            over_triangle(cell, upper + MACULA_PER_PIXEL_INVERSE, to_x, to_y, depth);
        const float16 lower_depth =
            over_triangle(cell, lower + MACULA_PER_PIXEL_INVERSE, to_x, to_y, depth);
        const uint16 rank = ranks(in_upper ? upper_depth : lower_depth, depth_bits);
        const uint16 key = (in_upper | in_lower) ? rank << shift | place : (uint16)(MACULA_NO_KEY);
        global uint* row = keys + (uint)y * pitch + (uint)x;
        vstore8(min(vload8(0, row), key.lo), 0, row);
        vstore8(min(vload8(0, row + pitch), key.hi), 0, row + pitch);
    }
}

MACULA_ALWAYS_INLINE void draw_cells(global const float* block, const Tile* tile, uint depth_bits,
                                     uint pitch, global uint* keys) {
    global const int* numbers = (global const int*)block;
    const int16 left = vload16(MACULA_OUTLINE_LEFT, numbers);
    const int16 top = vload16(MACULA_OUTLINE_TOP, numbers);
    const int16 right = vload16(MACULA_OUTLINE_RIGHT, numbers);
    const int16 bottom = vload16(MACULA_OUTLINE_BOTTOM, numbers);
    const int16 met = (left < tile->right) & (right > tile->left) & (top < tile->bottom) &
                      (bottom > tile->top) & (left < right) & (top < bottom);
    for (uint lanes = bits_of_lanes16(met); lanes != 0u; lanes &= lanes - 1u) {
        const uint lane = popcount((lanes & -lanes) - 1u);
        global const int* cell = numbers + lane;
        const int y_begin = max(cell[MACULA_OUTLINE_TOP * 16u], tile->top) & ~1;
        const int y_end = min(cell[MACULA_OUTLINE_BOTTOM * 16u], tile->bottom);
        const int x_end = min(cell[MACULA_OUTLINE_RIGHT * 16u], tile->right);
        for (int x = max(cell[MACULA_OUTLINE_LEFT * 16u], tile->left); x < x_end; x += 8)
            draw_columns(block + lane, depth_bits, pitch, min(x, tile->right - 8), y_begin, y_end,
                         keys);
    }
}

/* One work-item a tile of MACULA_WIDE pixels and MACULA_DRAWN_TILE rows. It looks at the bounds of
 * all blocks, so that wide ones are cheaper where there are few threads. */
kernel void draw_mesh(global const WeierParams* restrict weier,
                      global const float* restrict outlines, global const float* restrict fronts,
                      global const int* restrict bounds, uint rows, global uint* restrict keys) {
    const uint across = weier->support_width, down = weier->support_height;
    const uint pitch = weier->pitch, count = cell_blocks(across, down);
    const uint plane = bounds_pitch(across, down);
    const uint across_tiles = (pitch + MACULA_WIDE - 1u) / MACULA_WIDE;
    const uint index = (uint)get_global_id(0), stride = MACULA_OUTLINE_FIELDS * 16u;
    Tile tile;
    tile.left = (int)(index % across_tiles * MACULA_WIDE);
    tile.top = (int)(index / across_tiles * MACULA_DRAWN_TILE);
    if (tile.top >= (int)rows)
        return;
    tile.right = min(tile.left + (int)MACULA_WIDE, (int)pitch);
    tile.bottom = tile.top + (int)MACULA_DRAWN_TILE;
    for (int y = tile.top; y < tile.bottom; ++y)
        for (int x = tile.left; x < tile.right; x += 16)
            vstore16((uint16)(MACULA_NO_KEY), 0, keys + (uint)y * pitch + (uint)x);
    for (uint first = 0u; first < count; first += 16u) {
        global const int* box = bounds + first;
        const int16 met = (vload16(0, box) < tile.right) & (vload16(0, box + plane) < tile.bottom) &
                          (vload16(0, box + 2u * plane) > tile.left) &
                          (vload16(0, box + 3u * plane) > tile.top) &
                          (MACULA_LANES16 < (int16)((int)(count - first)));
        for (uint lanes = bits_of_lanes16(met); lanes != 0u; lanes &= lanes - 1u) {
            const uint block = first + popcount((lanes & -lanes) - 1u);
            draw_cells(outlines + block * stride, &tile, weier->depth_bits, pitch, keys);
            if (bounds[MACULA_BOUNDS_SECOND * plane + block] != 0)
                draw_cells(fronts + block * stride, &tile, weier->depth_bits, pitch, keys);
        }
    }
}
