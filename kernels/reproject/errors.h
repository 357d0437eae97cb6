/* Which cells of the mesh need new samples (Weier et al. 2016, section 3.3), for sixteen cells at a
 * time. OpenCL C only. */
#ifndef MACULA_REPROJECT_ERRORS_H
#define MACULA_REPROJECT_ERRORS_H

#include "reproject/lanes.h"

/* A row of support samples as the detection of errors sees it. */
typedef struct Corners {
    Quad16 vertex;
    Vector16 ray, normal; /* world space; the ray's depth is 1 */
    float16 inverse_depth, luminance;
    float16 along; /* normal . ray: below 0 */
    uint16 motion; /* number of reproject/motion.h */
} Corners;

MACULA_ALWAYS_INLINE float16 luminances(const Quad16* colour) {
    const float16 value =
        fma(colour->x, (float16)(0.2126f), fma(colour->y, (float16)(0.7152f), colour->z * 0.0722f));
    return value < 0.0f ? (float16)(0.0f) : (value > 1.0f ? (float16)(1.0f) : value);
}

/* What the corners are made from. */
typedef struct Samples {
    global const float4 *support, *image, *vertices;
    global const float *columns, *rows; /* of the mesh, pixels */
    global const uint* motion;          /* null where nothing moved */
} Samples;

MACULA_ALWAYS_INLINE void load_corners(global const FrameParams* frame,
                                       global const WeierParams* weier, const Samples* from, uint i,
                                       uint j, Corners* c) {
    const uint across = weier->support_width, count = across * weier->support_height;
    const uint first = j * across + i;
    const Quad16 geometry = load_quads(from->support, first, count);
    const Quad16 colour = load_quads(from->image, first, count);
    c->vertex = load_quads(from->vertices, first, count);
    c->ray = past_rays(frame, load_lanes(from->columns, i, across), from->rows[j]);
    c->normal.x = geometry.x;
    c->normal.y = geometry.y;
    c->normal.z = geometry.z;
    c->inverse_depth = inverse_depths(geometry.w);
    c->luminance = luminances(&colour);
    c->along = dot3(c->normal, c->ray);
    c->motion = (uint16)(0u);
    if (from->motion)
        c->motion = load_row_lanes(from->motion + j * across, (int)i, across);
}

/* How far `other` is from the plane of `corner`, as a part of the depth: along a plane the inverse
 * depth goes as normal . ray. The background's normal is 0; it fits itself alone. */
MACULA_ALWAYS_INLINE float16 off_plane(const Corners* corner, const Corners* other) {
    const int16 facing = corner->along <= -1e-6f;
    const float16 along = facing ? corner->along : (float16)(-1.0f);
    const float16 expected =
        corner->inverse_depth * m_divide(dot3(corner->normal, other->ray), along);
    const float16 larger = m_max(expected, other->inverse_depth);
    const float16 part =
        m_divide(fabs(expected - other->inverse_depth), larger > 0.0f ? larger : (float16)(1.0f));
    const float16 apart = other->along > -1e-6f ? (float16)(0.0f) : (float16)(1.0f);
    return facing ? part : apart;
}

/* The depth's difference beyond the surface's own slope, seen from both ends. */
MACULA_ALWAYS_INLINE float16 jump_between(const Corners* a, const Corners* b) {
    return m_max(off_plane(a, b), off_plane(b, a));
}

/* Where edge_t of section 3.3 is too small. */
MACULA_ALWAYS_INLINE int16 is_grazing(const Corners* c, float threshold) {
    const float16 edge = -c->along * m_inverse_sqrt(dot3(c->ray, c->ray));
    return (c->along < -1e-6f) & (edge < threshold);
}

MACULA_ALWAYS_INLINE float16 length_ratio(const Quad16* a, const Quad16* b, float16 before) {
    const float16 x = b->x - a->x, y = b->y - a->y;
    return m_divide(m_sqrt(fma(x, x, y * y)), before);
}

/* Cells between objects that moved apart or together. */
MACULA_ALWAYS_INLINE int16 moved_apart(const Corners* c) {
    const uint16 a = c[0].motion;
    return (c[1].motion != a) | (c[2].motion != a) | (c[3].motion != a);
}

/* Such cells and those next to them: a corner of an object reaches further than its samples. */
MACULA_ALWAYS_INLINE int16 near_motion(global const uint* motion, uint i, uint j, uint across,
                                       uint down) {
    const uint16 here = load_row_lanes(motion + j * across, (int)i, across);
    int16 differs = (int16)(0);
    for (int y = (int)j - 1; y <= (int)j + 2; ++y)
        for (int x = (int)i - 1; x <= (int)i + 2; ++x)
            differs |= load_row_lanes(motion + (uint)clamp(y, 0, (int)down - 1) * across, x,
                                      across) != here;
    return differs;
}

MACULA_ALWAYS_INLINE float16 contrast_of(const Corners* c) {
    const float16 bright =
        m_max(m_max(c[0].luminance, c[1].luminance), m_max(c[2].luminance, c[3].luminance));
    const float16 dark =
        m_min(m_min(c[0].luminance, c[1].luminance), m_min(c[2].luminance, c[3].luminance));
    return bright - dark;
}

/* What a shadow's edge has at the least. */
#define LEAST_CONTRAST 0x1p-4f

/* Cells at a support sample that showed something else than its history did, and those at one that
 * did a while ago as long as an edge may still lie between their corners. */
MACULA_ALWAYS_INLINE int16 near_change(global const uint* change, const Corners* c, uint i, uint j,
                                       uint across) {
    global const uint *above = change + j * across, *below = above + across;
    const uint16 found =
        load_row_lanes(above, (int)i, across) | load_row_lanes(above, (int)i + 1, across) |
        load_row_lanes(below, (int)i, across) | load_row_lanes(below, (int)i + 1, across);
    return ((found & MACULA_CHANGE_NOW) != 0u) |
           ((found != 0u) & (contrast_of(c) > LEAST_CONTRAST));
}

MACULA_ALWAYS_INLINE int16 flag_where(int16 mask, uint flag) {
    return mask & (int16)((int)flag);
}

/* MACULA_RESAMPLE_* of the cells with corners c[0..3] in rows. */
MACULA_ALWAYS_INLINE int16 errors_of(const Corners* c, float16 step_x, float step_y,
                                     global const WeierParams* weier) {
    const float16 jump = m_max(m_max(jump_between(c, c + 1), jump_between(c + 2, c + 3)),
                               m_max(jump_between(c, c + 2), jump_between(c + 1, c + 3)));
    const float16 across = m_max(jump_between(c, c + 3), jump_between(c + 1, c + 2));
    const float16 stretch =
        m_max(m_max(length_ratio(&c[0].vertex, &c[1].vertex, step_x),
                    length_ratio(&c[2].vertex, &c[3].vertex, step_x)),
              m_max(length_ratio(&c[0].vertex, &c[2].vertex, (float16)(step_y)),
                    length_ratio(&c[1].vertex, &c[3].vertex, (float16)(step_y))));
    const float edge = weier->edge_threshold;
    const int16 grazing = is_grazing(c, edge) | is_grazing(c + 1, edge) | is_grazing(c + 2, edge) |
                          is_grazing(c + 3, edge);
    const int16 torn = (m_max(jump, across) > weier->depth_threshold) | moved_apart(c);
    return flag_where(torn, MACULA_RESAMPLE_DEPTH) |
           flag_where(contrast_of(c) > weier->luminance_threshold, MACULA_RESAMPLE_LUMINANCE) |
           flag_where(stretch > weier->stretch_threshold, MACULA_RESAMPLE_STRETCHED) |
           flag_where(grazing, MACULA_RESAMPLE_GRAZING);
}

#endif
