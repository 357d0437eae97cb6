/* One ray against the eight triangles of a TriangleBlock8, all of intersect_triangle of
 * lib/triangle.h in eight lanes. OpenCL C only. */
#ifndef MACULA_LIB_WIDE_BLOCK_H
#define MACULA_LIB_WIDE_BLOCK_H

#include "lib/math_vector.h"
#include "lib/traverse_block8.h"

/* A ray among blocks: its query, and the origin with the axes permuted. */
typedef struct BlockRay {
    TraceQuery query;
    float ox, oy, oz;
} BlockRay;

static inline void permute_origin(BlockRay* s) {
    const TraceRay* r = &s->query.ray;
    s->ox = pick_axis(r->kx, r->ox, r->oy, r->oz);
    s->oy = pick_axis(r->ky, r->ox, r->oy, r->oz);
    s->oz = pick_axis(r->kz, r->ox, r->oy, r->oz);
}

typedef struct BlockEdges {
    float8 wa, wb, wc;
    float8 az, bz, cz; /* of the vertices from the origin, along the dominant axis */
} BlockEdges;

/* The lanes whose triangle the ray's line crosses. */
static inline int8 cross_edges8(const BlockRay* s, global const TriangleBlock8* block,
                                BlockEdges* e) {
    const TraceRay* r = &s->query.ray;
    const uint kx = r->kx, ky = r->ky, kz = r->kz;
    e->az = vload8(0, block->v[0][kz]) - (float8)(s->oz);
    e->bz = vload8(0, block->v[1][kz]) - (float8)(s->oz);
    e->cz = vload8(0, block->v[2][kz]) - (float8)(s->oz);
    const float8 ax = sheared8(block->v[0][kx], s->ox, r->sx, e->az);
    const float8 ay = sheared8(block->v[0][ky], s->oy, r->sy, e->az);
    const float8 bx = sheared8(block->v[1][kx], s->ox, r->sx, e->bz);
    const float8 by = sheared8(block->v[1][ky], s->oy, r->sy, e->bz);
    const float8 cx = sheared8(block->v[2][kx], s->ox, r->sx, e->cz);
    const float8 cy = sheared8(block->v[2][ky], s->oy, r->sy, e->cz);
    e->wa = difference_of_products8(cx, by, cy, bx);
    e->wb = difference_of_products8(ax, cy, ay, cx);
    e->wc = difference_of_products8(bx, ay, by, ax);
    const float8 least = m_min8(m_min8(e->wa, e->wb), e->wc);
    const float8 greatest = m_max8(m_max8(e->wa, e->wb), e->wc);
    /* An edge function that is not 0 makes the determinant not 0: all have one sign. */
    return (least < (float8)(0.0f)) ^ (greatest > (float8)(0.0f));
}

/* Of the lanes `hit`, those whose t passes the interval and the triangle's own box. */
static inline int8 clamp_to_triangles8(const TraceRay* r, global const TriangleBlock8* block,
                                       int8 hit, float8* t) {
    float8 near, far;
    triangle_intervals8(r, block, &near, &far);
    hit &= (*t >= (float8)(r->t_min)) & (near <= far);
    *t = m_min8(m_max8(*t, near), far);
    return hit & (*t <= (float8)(r->t_max));
}

/* Finishes the test of the lanes that the ray's line crosses; true when the query is answered. */
static inline bool finish_block8(const TraceScene* scene, BlockRay* s,
                                 global const TriangleBlock8* block, const BlockEdges* e,
                                 int8 hit) {
    const TraceRay* r = &s->query.ray;
    const float8 one = 1.0f, shear = r->sz;
    const float8 inverse = m_divide(one, hit ? (e->wa + e->wb) + e->wc : one);
    const float8 scaled_t =
        fma(e->wa, shear * e->az, fma(e->wb, shear * e->bz, e->wc * (shear * e->cz)));
    float8 t = scaled_t * inverse;
    ulong lanes = lane_mask8(clamp_to_triangles8(r, block, hit, &t));
    if (lanes == 0ul)
        return false;
    const float8 u = e->wb * inverse, v = e->wc * inverse;
    do {
        const uint i = first_lane8(lanes);
        lanes = without_lane8(lanes, i);
        if (accept_hit(scene, &s->query, block->id[i], ((const float*)&t)[i], ((const float*)&u)[i],
                       ((const float*)&v)[i]))
            return true;
    } while (lanes != 0ul);
    return false;
}

/* True when the query is answered. */
static inline bool test_leaf_of_blocks(const TraceScene* scene, BlockRay* s, int leaf) {
    const uint bits = (uint)~leaf;
    global const TriangleBlock8* block =
        (global const TriangleBlock8*)scene->triangles + (bits >> MACULA_LEAF_COUNT_BITS);
    global const TriangleBlock8* end = block + (bits & MACULA_LEAF_MAX);
    for (; block != end; ++block) {
        BlockEdges edges;
        const int8 hit = cross_edges8(s, block, &edges);
        if (lane_mask8(hit) != 0ul && finish_block8(scene, s, block, &edges, hit))
            return true;
    }
    return false;
}

#endif
