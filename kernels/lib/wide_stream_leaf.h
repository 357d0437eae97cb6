/* The rays of a stream, and their test against the eight triangles of a TriangleBlock8. OpenCL C
 * only. */
#ifndef MACULA_LIB_WIDE_STREAM_LEAF_H
#define MACULA_LIB_WIDE_STREAM_LEAF_H

#include "lib/traverse_block8.h"
#include "lib/traverse_query.h"
#include "lib/wide_stream_ray.h"

#define MACULA_STREAM_LANES 32

/* A chunk of rays. Bit k of a ray mask stands for ray k. */
typedef struct Stream {
    StreamRay* ray;
    float16 t_max[2]; /* the best t so far, of closest-hit queries */
    TraceHit best[MACULA_ANY_HIT ? 1 : MACULA_STREAM_LANES];
    /* Of the instance being traversed: */
#if MACULA_INSTANCES
    InstanceSpan span[MACULA_STREAM_LANES];
#endif
    uint first_triangle;
    uint mesh_triangle;
} Stream;

/* What the edge test of a block leaves for the rest of the test, for two rays. */
typedef struct BlockHits {
    int16 hit;
    float16 t, u, v;
    float16 determinant;
} BlockHits;

/* The vertices of a block, with the axes of a class, for two rays. */
typedef struct BlockVertices {
    float16 ax, ay, az, bx, by, bz, cx, cy, cz;
} BlockVertices;

static inline BlockVertices load_vertices(global const TriangleBlock8* block,
                                          const StreamClass* c) {
    BlockVertices v;
    v.ax = twice(vload8(0, block->v[0][c->kx]));
    v.ay = twice(vload8(0, block->v[0][c->ky]));
    v.az = twice(vload8(0, block->v[0][c->kz]));
    v.bx = twice(vload8(0, block->v[1][c->kx]));
    v.by = twice(vload8(0, block->v[1][c->ky]));
    v.bz = twice(vload8(0, block->v[1][c->kz]));
    v.cx = twice(vload8(0, block->v[2][c->kx]));
    v.cy = twice(vload8(0, block->v[2][c->ky]));
    v.cz = twice(vload8(0, block->v[2][c->kz]));
    return v;
}

static inline float16 sheared(float16 plane, float16 origin, float16 shear, float16 depth) {
    const float16 x = fma(-shear, depth, plane - origin);
    return fabs(x) < 0x1p-40f ? (float16)(0.0f) : x;
}

static inline float16 product_difference(float16 a, float16 b, float16 c, float16 d) {
    const float16 cd = c * d;
    return fma(a, b, -cd) + fma(-c, d, cd);
}

/* intersect_triangle for the rays of two rows, up to the triangle's own box. A t beyond the ray's
 * end stays there, as it lies in the box (docs/arithmetic.md) unless it overflows. */
static inline BlockHits hit_block(float16 first, float16 second, const BlockVertices* p) {
    const float16 ox = MACULA_OF_BOTH(first, second, s8), oy = MACULA_OF_BOTH(first, second, s9),
                  oz = MACULA_OF_BOTH(first, second, sa);
    const float16 sx = MACULA_OF_BOTH(first, second, sb), sy = MACULA_OF_BOTH(first, second, sc),
                  sz = MACULA_OF_BOTH(first, second, sd);
    const float16 az = p->az - oz, bz = p->bz - oz, cz = p->cz - oz;
    const float16 ax = sheared(p->ax, ox, sx, az), ay = sheared(p->ay, oy, sy, az);
    const float16 bx = sheared(p->bx, ox, sx, bz), by = sheared(p->by, oy, sy, bz);
    const float16 cx = sheared(p->cx, ox, sx, cz), cy = sheared(p->cy, oy, sy, cz);
    const float16 wa = product_difference(cx, by, cy, bx);
    const float16 wb = product_difference(ax, cy, ay, cx);
    const float16 wc = product_difference(bx, ay, by, ax);
    const float16 least = m_min(m_min(wa, wb), wc);
    const float16 greatest = m_max(m_max(wa, wb), wc);
    BlockHits h;
    /* An edge function that is not 0 makes the determinant not 0: all have one sign. */
    h.hit = (least < 0.0f) ^ (greatest > 0.0f);
    h.determinant = (wa + wb) + wc;
    const float16 inverse = m_divide((float16)(1.0f), h.hit ? h.determinant : (float16)(1.0f));
    h.t = fma(wa, sz * az, fma(wb, sz * bz, wc * (sz * cz))) * inverse;
    h.u = wb * inverse;
    h.v = wc * inverse;
    const float16 t_max = MACULA_OF_BOTH(first, second, s6);
    const float16 t_min = MACULA_OF_BOTH(first, second, s7);
    h.hit &= (h.t >= t_min) & ((h.t <= t_max) | (h.t > 0x1p126f));
    return h;
}

/* Of the lanes `hit`, those whose t passes the triangle's own box and then ends before the ray. */
static inline int8 clamp_to_triangles8(const StreamRay* ray, const StreamClass* c,
                                       global const TriangleBlock8* block, int8 hit, float8* t) {
    TraceRay r;
    float o[3];
    o[c->kx] = ray->value[MACULA_ROW_O];
    o[c->ky] = ray->value[MACULA_ROW_O + 1u];
    o[c->kz] = ray->value[MACULA_ROW_O + 2u];
    r.ox = o[0];
    r.oy = o[1];
    r.oz = o[2];
    r.rx = ray->value[MACULA_ROW_R];
    r.ry = ray->value[MACULA_ROW_R + 1u];
    r.rz = ray->value[MACULA_ROW_R + 2u];
    set_offsets(&r);
    r.t_min = ray->value[MACULA_ROW_T_MIN];
    r.octant = c->octant;
    float8 near, far;
    triangle_intervals8(&r, block, &near, &far);
    hit &= near <= far;
    *t = m_min8(m_max8(*t, near), far);
    return hit & (*t <= (float8)(ray->value[MACULA_ROW_T_MAX]));
}

/* Takes the hit on one triangle of a block if accept_hit does; true when the query is answered. */
static inline bool take_lane(const TraceScene* scene, Stream* s, uint k, uint id, float t, float u,
                             float v) {
    TraceQuery query;
#if !MACULA_ANY_HIT
    query.best = s->best[k];
#endif
#if MACULA_INSTANCES
    query.span = s->span[k];
#endif
    query.first_triangle = s->first_triangle;
    query.mesh_triangle = s->mesh_triangle;
    query.ray.t_max = s->ray[k].value[MACULA_ROW_T_MAX];
    const bool answered = accept_hit(scene, &query, id, t, u, v);
#if !MACULA_ANY_HIT
    s->best[k] = query.best;
    s->ray[k].value[MACULA_ROW_T_MAX] = query.ray.t_max;
    ((float*)s->t_max)[k] = query.ray.t_max;
#endif
    return answered;
}

/* Takes the hits of ray k on a block; returns its bit when the query is answered. `plain`: all hits
 * pass the boxes of their triangles. */
static inline uint take_hits(const TraceScene* scene, Stream* s, const StreamClass* c, bool plain,
                             uint k, global const TriangleBlock8* block, int8 hit, float8 t,
                             float8 u, float8 v) {
    ulong lanes = lane_mask8(hit);
    if (lanes != 0ul && !plain)
        lanes = lane_mask8(clamp_to_triangles8(s->ray + k, c, block, hit, &t));
    while (lanes != 0ul) {
        const uint i = first_lane8(lanes);
        lanes = without_lane8(lanes, i);
        if (take_lane(scene, s, k, block->id[i], ((const float*)&t)[i], ((const float*)&u)[i],
                      ((const float*)&v)[i]))
            return 1u << k;
    }
    return 0u;
}

/* The rays of a leaf, two at a time, against the triangles of a block. Returns those whose query is
 * answered. */
static inline uint test_block_of_stream(const TraceScene* scene, Stream* s, const StreamClass* c,
                                        global const TriangleBlock8* block, uint rays) {
    const BlockVertices vertices = load_vertices(block, c);
    uint answered = 0u;
    while (rays != 0u) {
        const RayPair pair = next_pair(&rays);
        const BlockHits h = hit_block(s->ray[pair.first].row, s->ray[pair.second].row, &vertices);
        if (!any_lane16(h.hit))
            continue;
        const bool plain =
            c->plain && !any_lane16(h.hit & (fabs(h.determinant) < MACULA_PLAIN_DETERMINANT));
        answered |=
            take_hits(scene, s, c, plain, pair.first, block, h.hit.lo, h.t.lo, h.u.lo, h.v.lo);
        if (pair.second != pair.first)
            answered |= take_hits(scene, s, c, plain, pair.second, block, h.hit.hi, h.t.hi, h.u.hi,
                                  h.v.hi);
    }
    return answered;
}

/* Returns the rays whose query is answered. */
static inline uint test_leaf_of_stream(const TraceScene* scene, Stream* s, const StreamClass* c,
                                       int leaf, uint rays) {
    const uint bits = (uint)~leaf;
    global const TriangleBlock8* block =
        (global const TriangleBlock8*)scene->triangles + (bits >> MACULA_LEAF_COUNT_BITS);
    global const TriangleBlock8* end = block + (bits & MACULA_LEAF_MAX);
    uint answered = 0u;
    for (; block != end; ++block)
        answered |= test_block_of_stream(scene, s, c, block, rays & ~answered);
    return answered;
}

#endif
