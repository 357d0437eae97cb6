/* The cells of the reprojected mesh (lib/reprojection.h), prepared once a frame for those that draw
 * them and for those that look up histories. Cells lie in blocks of sixteen neighbours of a row, a
 * block field by field: whoever makes them has sixteen lanes, whoever uses one reads its lane. */
#ifndef MACULA_LIB_MESH_CELLS_H
#define MACULA_LIB_MESH_CELLS_H

#include "shared/weier.h"

MACULA_SHARED_BEGIN

#define MACULA_CELL_LANES 16u

/* A cell for looking up histories: the place of its first corner, the diagonal to its last one, and
 * for each of its two triangles functions that are linear on the screen, relative to the first
 * corner. FROM_X, FROM_Y: the place in the last frame relative to the first corner's, times the
 * ratio of the depths; RATIO: that ratio; DEPTH: the inverse depth. */
#define MACULA_CELL_X 0u
#define MACULA_CELL_Y 1u
#define MACULA_CELL_DIAGONAL_X 2u
#define MACULA_CELL_DIAGONAL_Y 3u
#define MACULA_CELL_RATIO 4u     /* at the first corner */
#define MACULA_CELL_DEPTH 5u     /* likewise */
#define MACULA_CELL_FOOTPRINT 6u /* squared length of the longest change for one pixel, texels */
#define MACULA_CELL_UPPER 8u     /* the triangle along the cell's upper edge */
#define MACULA_CELL_LOWER 16u    /* and the one along its left edge */
/* Of a triangle: change for one pixel to the right; the next field: for one pixel down. */
#define MACULA_PER_PIXEL_RATIO 0u
#define MACULA_PER_PIXEL_FROM_X 2u
#define MACULA_PER_PIXEL_FROM_Y 4u
#define MACULA_PER_PIXEL_DEPTH 6u
#define MACULA_CELL_FIELDS 24u

/* A cell for drawing: the first corner, the pixels that it may cover (integers, the ends excluded;
 * none: nothing is drawn), and for each triangle the weights of its other two corners. */
#define MACULA_OUTLINE_X 0u
#define MACULA_OUTLINE_Y 1u
#define MACULA_OUTLINE_DEPTH 2u /* inverse, at the first corner */
#define MACULA_OUTLINE_KEY 3u   /* integer: the key without the depth's rank */
#define MACULA_OUTLINE_LEFT 4u
#define MACULA_OUTLINE_TOP 5u
#define MACULA_OUTLINE_RIGHT 6u
#define MACULA_OUTLINE_BOTTOM 7u
#define MACULA_OUTLINE_UPPER 8u
#define MACULA_OUTLINE_LOWER 14u
#define MACULA_PER_PIXEL_B 0u
#define MACULA_PER_PIXEL_C 2u
#define MACULA_PER_PIXEL_INVERSE 4u
#define MACULA_OUTLINE_FIELDS 20u

/* Planes of the blocks' bounds: pixels as above, and the last one not 0 where some cell of the
 * block is drawn a second time. */
#define MACULA_BOUNDS_LEFT 0u
#define MACULA_BOUNDS_TOP 1u
#define MACULA_BOUNDS_RIGHT 2u
#define MACULA_BOUNDS_BOTTOM 3u
#define MACULA_BOUNDS_SECOND 4u
#define MACULA_BOUNDS_FIELDS 5u

/* The screen is drawn in tiles of this many rows; the rows of the keys are a multiple of it. */
#define MACULA_DRAWN_TILE 32u

MACULA_ALWAYS_INLINE uint cell_blocks_across(uint support_width) {
    return (support_width + MACULA_CELL_LANES - 1u) / MACULA_CELL_LANES;
}

/* Blocks of a mesh; a plane of bounds has as many entries, rounded up to sixteen. */
MACULA_ALWAYS_INLINE uint cell_blocks(uint support_width, uint support_height) {
    return cell_blocks_across(support_width) * support_height;
}

MACULA_ALWAYS_INLINE uint bounds_pitch(uint support_width, uint support_height) {
    return (cell_blocks(support_width, support_height) + 15u) / 16u * 16u;
}

MACULA_SHARED_END
#endif
