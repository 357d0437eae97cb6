/* The rays of a stream, and their test against the eight triangles of a TriangleBlock8. OpenCL C
 * only. */
#ifndef MACULA_LIB_WIDE_STREAM_LEAF_H
#define MACULA_LIB_WIDE_STREAM_LEAF_H

#include "lib/ray16.h"
#include "lib/traverse_block8.h"
#include "lib/traverse_query.h"
#include "lib/wide_push.h"

#define MACULA_STREAM_LANES 32

/* Rays side by side: vectors are [axis][ray]. Bit k of a ray mask stands for ray k. */
typedef struct Stream {
    float r[3][MACULA_STREAM_LANES]; /* TraceRay.rx .. rz, and nx .. nz */
    float n[3][MACULA_STREAM_LANES];
    float t_max[MACULA_STREAM_LANES];
    float o[3][MACULA_STREAM_LANES];
    float sx[MACULA_STREAM_LANES], sy[MACULA_STREAM_LANES];
    float t_min[MACULA_STREAM_LANES];
    TraceHit best[MACULA_STREAM_LANES];
    /* Of the instance being traversed: */
#if MACULA_INSTANCES
    InstanceSpan span[MACULA_STREAM_LANES];
#endif
    uint first_triangle;
    uint mesh_triangle;
} Stream;

/* What the rays of a traversal have in common. */
typedef struct StreamClass {
    uint octant;
    uint kx, ky, kz;
    float margin; /* of far planes, see far_plane8 */
} StreamClass;

/* Classes of rays by octant and dominant axis. */
#define MACULA_STREAM_CLASSES 24u

static inline StreamClass stream_class(uint index, float reach) {
    StreamClass c;
    c.octant = index / 3u;
    c.kz = index % 3u;
    c.kx = c.kz == 2u ? 0u : c.kz + 1u;
    c.ky = c.kx == 2u ? 0u : c.kx + 1u;
    c.margin = 4.0f * MACULA_RAY_MARGIN * reach;
    return c;
}

/* What the edge test of a block leaves for the rest of the test. */
typedef struct BlockHits {
    int8 hit;
    float8 t, u, v;
} BlockHits;

/* The vertices of a block, with the axes of a class. */
typedef struct BlockVertices {
    float8 ax, ay, az, bx, by, bz, cx, cy, cz;
} BlockVertices;

static inline BlockVertices load_vertices(global const TriangleBlock8* block,
                                          const StreamClass* c) {
    BlockVertices v;
    v.ax = vload8(0, block->v[0][c->kx]);
    v.ay = vload8(0, block->v[0][c->ky]);
    v.az = vload8(0, block->v[0][c->kz]);
    v.bx = vload8(0, block->v[1][c->kx]);
    v.by = vload8(0, block->v[1][c->ky]);
    v.bz = vload8(0, block->v[1][c->kz]);
    v.cx = vload8(0, block->v[2][c->kx]);
    v.cy = vload8(0, block->v[2][c->ky]);
    v.cz = vload8(0, block->v[2][c->kz]);
    return v;
}

static inline float8 sheared8of(float8 plane, float8 origin, float8 shear, float8 depth) {
    return snap_tiny8(fma(-shear, depth, plane - origin));
}

/* intersect_triangle for ray k up to the triangle's own box. A t beyond the ray's end stays there,
 * as it lies in the box (docs/arithmetic.md) unless it overflows. */
static inline BlockHits hit_block(const Stream* s, const StreamClass* c, uint k,
                                  const BlockVertices* p) {
    const float8 ox = s->o[c->kx][k], oy = s->o[c->ky][k], oz = s->o[c->kz][k];
    const float8 sx = s->sx[k], sy = s->sy[k], sz = s->r[c->kz][k];
    const float8 az = p->az - oz, bz = p->bz - oz, cz = p->cz - oz;
    const float8 ax = sheared8of(p->ax, ox, sx, az), ay = sheared8of(p->ay, oy, sy, az);
    const float8 bx = sheared8of(p->bx, ox, sx, bz), by = sheared8of(p->by, oy, sy, bz);
    const float8 cx = sheared8of(p->cx, ox, sx, cz), cy = sheared8of(p->cy, oy, sy, cz);
    const float8 wa = difference_of_products8(cx, by, cy, bx);
    const float8 wb = difference_of_products8(ax, cy, ay, cx);
    const float8 wc = difference_of_products8(bx, ay, by, ax);
    const float8 least = m_min8(m_min8(wa, wb), wc);
    const float8 greatest = m_max8(m_max8(wa, wb), wc);
    BlockHits h;
    /* An edge function that is not 0 makes the determinant not 0: all have one sign. */
    h.hit = (least < (float8)(0.0f)) ^ (greatest > (float8)(0.0f));
    const float8 inverse = m_divide((float8)(1.0f), h.hit ? (wa + wb) + wc : (float8)(1.0f));
    h.t = fma(wa, sz * az, fma(wb, sz * bz, wc * (sz * cz))) * inverse;
    h.u = wb * inverse;
    h.v = wc * inverse;
    const int8 ends_before = (h.t <= (float8)(s->t_max[k])) | (h.t > (float8)(0x1p126f));
    h.hit &= (h.t >= (float8)(s->t_min[k])) & ends_before;
    return h;
}

/* Of the lanes `hit`, those whose t passes the triangle's own box and then ends before the ray. */
static inline int8 clamp_to_triangles8(const Stream* s, const StreamClass* c, uint k,
                                       global const TriangleBlock8* block, int8 hit, float8* t) {
    TraceRay r;
    r.ox = s->o[0][k];
    r.oy = s->o[1][k];
    r.oz = s->o[2][k];
    r.rx = s->r[0][k];
    r.ry = s->r[1][k];
    r.rz = s->r[2][k];
    set_offsets(&r);
    r.t_min = s->t_min[k];
    r.octant = c->octant;
    float8 near, far;
    triangle_intervals8(&r, block, &near, &far);
    hit &= near <= far;
    *t = m_min8(m_max8(*t, near), far);
    return hit & (*t <= (float8)(s->t_max[k]));
}

/* Takes the hit on one triangle of a block if accept_hit does; true when the query is answered. */
static inline bool take_lane(const TraceScene* scene, Stream* s, uint k, uint id, float t, float u,
                             float v) {
    TraceQuery query;
    query.best = s->best[k];
#if MACULA_INSTANCES
    query.span = s->span[k];
#endif
    query.first_triangle = s->first_triangle;
    query.mesh_triangle = s->mesh_triangle;
    query.ray.t_max = s->t_max[k];
    const bool answered = accept_hit(scene, &query, id, t, u, v);
    s->best[k] = query.best;
    s->t_max[k] = query.ray.t_max;
    return answered;
}

/* Takes the hits of ray k on a block; true when the query is answered. */
static inline bool take_hits(const TraceScene* scene, Stream* s, const StreamClass* c, uint k,
                             global const TriangleBlock8* block, BlockHits* h) {
    ulong lanes = lane_mask8(clamp_to_triangles8(s, c, k, block, h->hit, &h->t));
    for (; lanes != 0ul;) {
        const uint i = first_lane8(lanes);
        lanes = without_lane8(lanes, i);
        if (take_lane(scene, s, k, block->id[i], ((const float*)&h->t)[i], ((const float*)&h->u)[i],
                      ((const float*)&h->v)[i]))
            return true;
    }
    return false;
}

/* The rays of a leaf, one after another, against the triangles of a block. Returns those whose
 * query is answered. */
static inline uint test_block_of_stream(const TraceScene* scene, Stream* s, const StreamClass* c,
                                        global const TriangleBlock8* block, uint rays) {
    const BlockVertices vertices = load_vertices(block, c);
    uint answered = 0u;
    for (; rays != 0u; rays &= rays - 1u) {
        const uint k = first_bit(rays);
        BlockHits h = hit_block(s, c, k, &vertices);
        if (lane_mask8(h.hit) != 0ul && take_hits(scene, s, c, k, block, &h))
            answered |= 1u << k;
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
