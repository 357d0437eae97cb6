/* The cells of the mesh: which need new samples (Weier et al. 2016, section 3.3), and what drawing
 * them and looking up histories in them takes (lib/mesh_cells.h). */
#include "reproject/errors.h"

/* Cells that span more pixels than this in x or y are not drawn: nothing is known there. */
#define MOST_PIXELS 64.0f

/* The pixels that a cell may cover; no cell where the ends are not after the beginnings. */
typedef struct Bounds {
    int16 left, top, right, bottom;
} Bounds;

MACULA_ALWAYS_INLINE float16 least_of(float16 a, float16 b, float16 c, float16 d) {
    return m_min(m_min(a, b), m_min(c, d));
}

MACULA_ALWAYS_INLINE float16 greatest_of(float16 a, float16 b, float16 c, float16 d) {
    return m_max(m_max(a, b), m_max(c, d));
}

/* Nothing is drawn of a cell that lies outside of the view or spans too many pixels. */
MACULA_ALWAYS_INLINE int16 find_bounds(const Quad16* a, const Quad16* b, const Quad16* c,
                                       const Quad16* d, global const FrameParams* frame,
                                       Bounds* bounds) {
    const float width = (float)frame->width, height = (float)frame->height;
    const float16 left = least_of(a->x, b->x, c->x, d->x) - 0.5f;
    const float16 top = least_of(a->y, b->y, c->y, d->y) - 0.5f;
    const float16 right = greatest_of(a->x, b->x, c->x, d->x);
    const float16 bottom = greatest_of(a->y, b->y, c->y, d->y);
    const int16 drawable = (least_of(a->z, b->z, c->z, d->z) > 0.0f) & (right > 0.0f) &
                           (bottom > 0.0f) & (left < width) & (top < height) &
                           (right - left < MOST_PIXELS) & (bottom - top < MOST_PIXELS);
    const int16 none = (int16)(0);
    bounds->left = drawable ? max(convert_int16(floor(left)), none) : none;
    bounds->top = drawable ? max(convert_int16(floor(top)), none) : none;
    bounds->right =
        drawable ? min(convert_int16(floor(right)) + 1, (int16)((int)frame->width)) : none;
    bounds->bottom =
        drawable ? min(convert_int16(floor(bottom)) + 1, (int16)((int)frame->height)) : none;
    return drawable;
}

/* A triangle with the corners a, b, c: the weights of b and c over the screen. */
typedef struct Weights {
    float16 area, b_x, b_y, c_x, c_y;
} Weights;

MACULA_ALWAYS_INLINE Weights weights_of(const Quad16* a, const Quad16* b, const Quad16* c) {
    const float16 side_x = b->x - a->x, side_y = b->y - a->y;
    const float16 diagonal_x = c->x - a->x, diagonal_y = c->y - a->y;
    Weights w;
    w.area = fma(side_x, diagonal_y, -(side_y * diagonal_x));
    const int16 flat = !(fabs(w.area) > 1e-12f);
    const float16 inverse = m_divide((float16)(1.0f), flat ? (float16)(1.0f) : w.area);
    const float16 share = flat ? (float16)(0.0f) : inverse;
    w.b_x = diagonal_y * share;
    w.b_y = -diagonal_x * share;
    w.c_x = -side_y * share;
    w.c_y = side_x * share;
    return w;
}

MACULA_ALWAYS_INLINE void put(global float* block, uint field, float16 value) {
    vstore16(value, field, block);
}

MACULA_ALWAYS_INLINE void put_triangle(global float* block, uint triangle, const Weights* own,
                                       const Weights* other, int16 has, const Quad16* a,
                                       const Quad16* own_b, const Quad16* other_b,
                                       const Quad16* c) {
    /* The other triangle stands in for one that faces away. */
    const float16 b_x = has ? own->b_x : other->b_x, b_y = has ? own->b_y : other->b_y;
    const float16 c_x = has ? own->c_x : other->c_x, c_y = has ? own->c_y : other->c_y;
    const float16 by_b = (has ? own_b->z : other_b->z) - a->z, by_c = c->z - a->z;
    put(block, triangle + MACULA_PER_PIXEL_B, b_x);
    put(block, triangle + MACULA_PER_PIXEL_B + 1u, b_y);
    put(block, triangle + MACULA_PER_PIXEL_C, c_x);
    put(block, triangle + MACULA_PER_PIXEL_C + 1u, c_y);
    put(block, triangle + MACULA_PER_PIXEL_INVERSE, fma(by_b, b_x, by_c * c_x));
    put(block, triangle + MACULA_PER_PIXEL_INVERSE + 1u, fma(by_b, b_y, by_c * c_y));
}

/* Cells with the corners a, b, c, d in rows, for drawing. Returns where there is something of one
 * to draw; `bounds` are none elsewhere. */
MACULA_ALWAYS_INLINE int16 put_outlines(global float* block, int16 wanted, int16 key,
                                        const Quad16* a, const Quad16* b, const Quad16* c,
                                        const Quad16* d, const Weights* upper, const Weights* lower,
                                        Bounds* bounds) {
    const int16 has_upper = upper->area > 1e-6f, has_lower = lower->area < -1e-6f;
    const int16 drawn = wanted & (has_upper | has_lower);
    const int16 none = (int16)(0);
    bounds->left = drawn ? bounds->left : none;
    bounds->top = drawn ? bounds->top : none;
    bounds->right = drawn ? bounds->right : none;
    bounds->bottom = drawn ? bounds->bottom : none;
    put(block, MACULA_OUTLINE_X, a->x);
    put(block, MACULA_OUTLINE_Y, a->y);
    put(block, MACULA_OUTLINE_DEPTH, a->z);
    put(block, MACULA_OUTLINE_KEY, as_float16(key));
    put(block, MACULA_OUTLINE_LEFT, as_float16(bounds->left));
    put(block, MACULA_OUTLINE_TOP, as_float16(bounds->top));
    put(block, MACULA_OUTLINE_RIGHT, as_float16(bounds->right));
    put(block, MACULA_OUTLINE_BOTTOM, as_float16(bounds->bottom));
    put_triangle(block, MACULA_OUTLINE_UPPER, upper, lower, has_upper, a, b, c, d);
    put_triangle(block, MACULA_OUTLINE_LOWER, lower, upper, has_lower, a, c, b, d);
    return drawn;
}

/* Corners a, b and d of a triangle in a table of cells; `b_x`, `b_y` and `x`, `y`: from a to b and
 * to d in the last frame. Returns the squared length of the longer change for one pixel. */
MACULA_ALWAYS_INLINE float16 put_homography(global float* block, uint triangle, const Weights* w,
                                            const Quad16* a, const Quad16* b, const Quad16* d,
                                            float16 b_x, float16 b_y, float16 x, float16 y) {
    const float16 b_more = b->w - a->w, d_more = d->w - a->w;
    const float16 b_deep = b->z - a->z, d_deep = d->z - a->z;
    const float16 part_b_x = w->b_x * b->w, part_b_y = w->b_y * b->w;
    const float16 part_c_x = w->c_x * d->w, part_c_y = w->c_y * d->w;
    put(block, triangle + MACULA_PER_PIXEL_RATIO, fma(b_more, w->b_x, d_more * w->c_x));
    put(block, triangle + MACULA_PER_PIXEL_RATIO + 1u, fma(b_more, w->b_y, d_more * w->c_y));
    put(block, triangle + MACULA_PER_PIXEL_FROM_X, fma(part_b_x, b_x, part_c_x * x));
    put(block, triangle + MACULA_PER_PIXEL_FROM_X + 1u, fma(part_b_y, b_x, part_c_y * x));
    put(block, triangle + MACULA_PER_PIXEL_FROM_Y, fma(part_b_x, b_y, part_c_x * y));
    put(block, triangle + MACULA_PER_PIXEL_FROM_Y + 1u, fma(part_b_y, b_y, part_c_y * y));
    put(block, triangle + MACULA_PER_PIXEL_DEPTH, fma(b_deep, w->b_x, d_deep * w->c_x));
    put(block, triangle + MACULA_PER_PIXEL_DEPTH + 1u, fma(b_deep, w->b_y, d_deep * w->c_y));
    const float16 right_x = fma(w->b_x, b_x, w->c_x * x), right_y = fma(w->b_x, b_y, w->c_x * y);
    const float16 down_x = fma(w->b_y, b_x, w->c_y * x), down_y = fma(w->b_y, b_y, w->c_y * y);
    return m_max(fma(right_x, right_x, right_y * right_y), fma(down_x, down_x, down_y * down_y));
}

MACULA_ALWAYS_INLINE void put_history(global float* block, const Corners* c, const Weights* upper,
                                      const Weights* lower, float16 step_x, float step_y) {
    const Quad16 *a = &c[0].vertex, *d = &c[3].vertex;
    const float16 none = (float16)(0.0f), y = (float16)(step_y);
    put(block, MACULA_CELL_X, a->x);
    put(block, MACULA_CELL_Y, a->y);
    put(block, MACULA_CELL_DIAGONAL_X, d->x - a->x);
    put(block, MACULA_CELL_DIAGONAL_Y, d->y - a->y);
    put(block, MACULA_CELL_RATIO, a->w);
    put(block, MACULA_CELL_DEPTH, a->z);
    const float16 above = put_homography(block, MACULA_CELL_UPPER, upper, a, &c[1].vertex, d,
                                         step_x, none, step_x, y);
    const float16 below =
        put_homography(block, MACULA_CELL_LOWER, lower, a, &c[2].vertex, d, none, y, step_x, y);
    put(block, MACULA_CELL_FOOTPRINT, m_max(above, below));
}

static inline int least_lane(int16 v) {
    const int8 a = min(v.lo, v.hi);
    const int4 b = min(a.lo, a.hi);
    const int2 c = min(b.lo, b.hi);
    return min(c.x, c.y);
}

static inline int greatest_lane(int16 v) {
    return -least_lane(-v);
}

/* The bounds of two sets of cells together. */
MACULA_ALWAYS_INLINE void put_bounds(global int* bounds, uint pitch, int16 drawn, const Bounds* b,
                                     int16 second, const Bounds* s) {
    const int16 most = (int16)(0x7fffffff);
    bounds[MACULA_BOUNDS_LEFT * pitch] =
        least_lane(min(drawn ? b->left : most, second ? s->left : most));
    bounds[MACULA_BOUNDS_TOP * pitch] =
        least_lane(min(drawn ? b->top : most, second ? s->top : most));
    bounds[MACULA_BOUNDS_RIGHT * pitch] = greatest_lane(max(b->right, s->right));
    bounds[MACULA_BOUNDS_BOTTOM * pitch] = greatest_lane(max(b->bottom, s->bottom));
    bounds[MACULA_BOUNDS_SECOND * pitch] = any_lane16(second) ? 1 : 0;
}

/* All corners moved to the depth of the nearest surface at one of them, and along with that. */
MACULA_ALWAYS_INLINE void move_to_front(global const FrameParams* frame,
                                        global const WeierParams* weier, const Motions* motions,
                                        const Corners* c, Quad16* moved) {
    const float16 front =
        greatest_of(c[0].inverse_depth, c[1].inverse_depth, c[2].inverse_depth, c[3].inverse_depth);
    const float16 far = fma(-0.5f, weier->depth_threshold, 1.0f) * front;
    uint16 motion = c[3].motion;
    for (uint k = 0u; k < 3u; ++k)
        motion = c[k].inverse_depth == front ? c[k].motion : motion;
    for (uint k = 0u; k < 4u; ++k) {
        const Quad16 v = project_vertices(frame, motions, motion, &c[k].ray, front);
        const int16 behind = (c[k].inverse_depth < far) | (c[k].motion != motion);
        moved[k].x = behind ? v.x : c[k].vertex.x;
        moved[k].y = behind ? v.y : c[k].vertex.y;
        moved[k].z = behind ? v.z : c[k].vertex.z;
    }
}

/* The second drawing of the cells in `torn`. Returns which there are. */
MACULA_ALWAYS_INLINE int16 put_fronts(global const FrameParams* frame,
                                      global const WeierParams* weier, const Motions* motions,
                                      const Corners* c, int16 torn, int16 place,
                                      global float* block, Bounds* bounds) {
    Quad16 v[4];
    move_to_front(frame, weier, motions, c, v);
    const int16 wanted = torn & find_bounds(v, v + 1, v + 2, v + 3, frame, bounds);
    const Weights upper = weights_of(v, v + 1, v + 3), lower = weights_of(v, v + 2, v + 3);
    return put_outlines(block, wanted, place, v, v + 1, v + 2, v + 3, &upper, &lower, bounds);
}

/* One work-item a block of sixteen cells, each to the right of and below its support sample.
 * errors: the resampling info, one word a support sample. cells, outlines, fronts, bounds:
 * lib/mesh_cells.h.
 *
 * A cell across a silhouette is drawn twice, both times for new samples. As it is, behind all else,
 * it covers what the front surface no longer hides. With all its corners moved to the front
 * surface's depth (`fronts`) it covers the fringe between the last sample on that surface and its
 * edge, which the mesh would lose to whatever passes behind. So are cells between objects that move
 * differently. motion: of project_mesh; change: what cache/change.cl found in the last frame, null
 * where nothing ever moves. */
kernel void
prepare_cells(global const FrameParams* restrict frame, global const WeierParams* restrict weier,
              global const float* restrict mesh_columns, global const float* restrict mesh_rows,
              global const float4* restrict support, global const float4* restrict support_image,
              global const float4* restrict vertices, uint moved,
              global const float* restrict matrices, global const uint* restrict motion,
              global const uint* restrict change, global uint* restrict errors,
              global float* restrict cells, global float* restrict outlines,
              global float* restrict fronts, global int* restrict bounds) {
    const uint across = weier->support_width, down = weier->support_height;
    const uint blocks = cell_blocks_across(across), block = (uint)get_global_id(0);
    const uint i = block % blocks * 16u, j = block / blocks;
    if (j >= down)
        return;
    const uint lanes = min(across - i, 16u), pitch = bounds_pitch(across, down);
    Bounds first, second;
    second.left = second.top = second.right = second.bottom = (int16)(0);
    int16 found = (int16)(0), drawn = (int16)(0), again = (int16)(0);
    first = second;
    if (j + 1u < down) {
        const Samples from = {support,   support_image, vertices, mesh_columns,
                              mesh_rows, moved != 0u ? motion : 0};
        Corners c[4];
        load_corners(frame, weier, &from, i, j, c);
        load_corners(frame, weier, &from, i + 1u, j, c + 1);
        load_corners(frame, weier, &from, i, j + 1u, c + 2);
        load_corners(frame, weier, &from, i + 1u, j + 1u, c + 3);
        const int16 column = (int16)((int)i) + MACULA_LANES16;
        const float16 step_x =
            load_lanes(mesh_columns, i + 1u, across) - load_lanes(mesh_columns, i, across);
        const float step_y = mesh_rows[j + 1u] - mesh_rows[j];
        const int16 drawable =
            find_bounds(&c[0].vertex, &c[1].vertex, &c[2].vertex, &c[3].vertex, frame, &first) &
            (column < (int16)((int)across - 1));
        found = errors_of(c, step_x, step_y, weier);
        if (moved != 0u)
            found |=
                flag_where(near_motion(motion, i, j, across, down), MACULA_RESAMPLE_CHANGED);
        if (change)
            found |= flag_where(near_change(change, c, i, j, across), MACULA_RESAMPLE_CHANGED);
        const int16 torn = drawable & ((found & (int16)MACULA_RESAMPLE_DEPTH) != 0);
        const int16 place =
            ((int16)((int)(j << weier->cell_bits_x)) | column) << 1 | ((found != 0) & 1);
        const uint last = ((1u << weier->depth_bits) - 1u) << (32u - weier->depth_bits);
        const Weights upper = weights_of(&c[0].vertex, &c[1].vertex, &c[3].vertex);
        const Weights lower = weights_of(&c[0].vertex, &c[2].vertex, &c[3].vertex);
        put_history(cells + block * (MACULA_CELL_FIELDS * 16u), c, &upper, &lower, step_x, step_y);
        drawn = put_outlines(outlines + block * (MACULA_OUTLINE_FIELDS * 16u), drawable,
                             place | (torn & (int16)((int)last)), &c[0].vertex, &c[1].vertex,
                             &c[2].vertex, &c[3].vertex, &upper, &lower, &first);
        const Motions motions = {moved, 0u, 0, matrices};
        if (any_lane16(torn))
            again = put_fronts(frame, weier, &motions, c, torn, place,
                               fronts + block * (MACULA_OUTLINE_FIELDS * 16u), &second);
        found = drawable ? found | (int16)MACULA_CELL_IN_VIEW : (int16)(0);
    }
    put_bounds(bounds + block, pitch, drawn, &first, again, &second);
    uint words[16];
    vstore16(as_uint16(found), 0, words);
    for (uint lane = 0u; lane < lanes; ++lane)
        errors[j * across + i + lane] = words[lane];
}
