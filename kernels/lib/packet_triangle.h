/* Sixteen rays against one triangle: intersect_triangle of lib/triangle.h lane by lane, and the
 * acceptance of hits as in lib/traverse_query.h. OpenCL C only. */
#ifndef MACULA_LIB_PACKET_TRIANGLE_H
#define MACULA_LIB_PACKET_TRIANGLE_H

#include "lib/packet.h"
#include "lib/traverse_query.h"

typedef struct PacketHit {
    float16 t, u, v;
    uint16 triangle;
} PacketHit;

/* The instance being traversed. */
typedef struct PacketInstance {
    float16 near; /* InstanceSpan.near of the lanes */
    uint first_triangle;
    uint mesh_triangle;
    bool plain; /* small enough for plain hits (lib/plain_hit.h) */
} PacketInstance;

static inline float16 snap_tiny16(float16 x) {
    return fabs(x) < 0x1p-40f ? (float16)(0.0f) : x;
}

static inline float16 difference_of_products16(float16 a, float16 b, float16 c, float16 d) {
    const float16 cd = c * d;
    return fma(a, b, -cd) + fma(-c, d, cd);
}

/* What the edge test leaves for the rest of the test. */
typedef struct PacketEdges {
    float16 wa, wb, wc;
    float16 az, bz, cz; /* of the origin from the vertices, along the dominant axis */
} PacketEdges;

/* The lanes with dominant axis kz whose line crosses the triangle. Differences are taken the other
 * way around than in intersect_triangle, since the broadcast of a vertex is then part of the
 * subtraction: sheared coordinates change their sign, and the edge functions stay the same. (An
 * edge function that is not 0
 * makes the determinant not 0, since all have the same sign.) */
static inline int16 cross_edges(const Packet* p, global const Triangle* tri, uint kz,
                                PacketEdges* e) {
    const uint kx = kz == 2u ? 0u : kz + 1u, ky = kx == 2u ? 0u : kx + 1u;
    const float16 ox = p->o[kx], oy = p->o[ky], oz = p->o[kz];
    e->az = oz - (float16)(tri->v0[kz]);
    e->bz = oz - (float16)(tri->v1[kz]);
    e->cz = oz - (float16)(tri->v2[kz]);
    const float16 ax = snap_tiny16(fma(-p->sx, e->az, ox - (float16)(tri->v0[kx])));
    const float16 ay = snap_tiny16(fma(-p->sy, e->az, oy - (float16)(tri->v0[ky])));
    const float16 bx = snap_tiny16(fma(-p->sx, e->bz, ox - (float16)(tri->v1[kx])));
    const float16 by = snap_tiny16(fma(-p->sy, e->bz, oy - (float16)(tri->v1[ky])));
    const float16 cx = snap_tiny16(fma(-p->sx, e->cz, ox - (float16)(tri->v2[kx])));
    const float16 cy = snap_tiny16(fma(-p->sy, e->cz, oy - (float16)(tri->v2[ky])));
    e->wa = difference_of_products16(cx, by, cy, bx);
    e->wb = difference_of_products16(ax, cy, ay, cx);
    e->wc = difference_of_products16(bx, ay, by, ax);
    const float16 least = m_min(m_min(e->wa, e->wb), e->wc);
    const float16 greatest = m_max(m_max(e->wa, e->wb), e->wc);
    return (least < 0.0f) ^ (greatest > 0.0f);
}

/* Of the lanes `hit`, those whose t passes the interval and the triangle's own box. */
static inline int16 clamp_to_triangle(const Packet* p, global const Triangle* tri, int16 hit,
                                      float16* t) {
    float lo[3], hi[3];
    for (uint axis = 0u; axis < 3u; ++axis) {
        lo[axis] = m_min(m_min(tri->v0[axis], tri->v1[axis]), tri->v2[axis]);
        hi[axis] = m_max(m_max(tri->v0[axis], tri->v1[axis]), tri->v2[axis]);
    }
    const float margin = triangle_margin(lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]);
    for (uint axis = 0u; axis < 3u; ++axis) {
        lo[axis] -= margin;
        hi[axis] += margin;
    }
    float16 near, far;
    box_interval16(p, lo, hi, &near, &far);
    hit &= (*t >= p->t_min) & (near <= far);
    *t = m_min(m_max(*t, near), far);
    return hit & (*t <= p->t_max);
}

#if MACULA_MASKS
/* Drops the lanes whose texel is not solid. */
static inline int16 keep_solid(const TraceScene* scene, uint slot, int16 hit, float16 u,
                               float16 v) {
    int16 solid = 0;
    for (uint bits = bits_of_lanes16(hit); bits != 0u; bits &= bits - 1u) {
        const uint i = first_lane(bits);
        if (mask_is_solid(&scene->masks, slot, ((const float*)&u)[i], ((const float*)&v)[i]))
            ((int*)&solid)[i] = -1;
    }
    return solid;
}
#endif

/* Finishes the test of the lanes that cross a triangle's edges and takes their hits; true when the
 * packet's bounds have changed. */
static inline bool finish_triangle(const TraceScene* scene, const PacketInstance* instance,
                                   Packet* p, PacketHit* best, global const Triangle* tri,
                                   const PacketEdges* e, int16 hit) {
    const float16 determinant = (e->wa + e->wb) + e->wc;
    const float16 inverse = m_divide((float16)(1.0f), hit ? determinant : (float16)(1.0f));
    const float16 scaled_t =
        fma(e->wa, p->sz * e->az, fma(e->wb, p->sz * e->bz, e->wc * (p->sz * e->cz)));
    float16 t = -scaled_t * inverse;
    if (instance->plain && p->plain &&
        !any_lane16(hit & (fabs(determinant) < MACULA_PLAIN_DETERMINANT)))
        hit &= (t >= p->t_min) & (t <= p->t_max);
    else
        hit = clamp_to_triangle(p, tri, hit, &t);
    const uint id = tri->id & MACULA_ID_MASK;
    const uint16 triangle = instance->first_triangle + id;
#if MACULA_INSTANCES
    t = m_max(t, instance->near);
    hit &= t <= p->t_max;
#endif
#if !MACULA_ANY_HIT
    hit &= (t < best->t) | ((t == best->t) & (triangle < best->triangle));
#endif
    const float16 u = e->wb * inverse, v = e->wc * inverse;
#if MACULA_MASKS
    if ((tri->id & MACULA_MASKED_BIT) != 0u && any_lane16(hit))
        hit = keep_solid(scene, instance->mesh_triangle + id, hit, u, v);
#endif
    if (!any_lane16(hit))
        return false;
    best->triangle = hit ? triangle : best->triangle;
#if MACULA_ANY_HIT
    p->t_max = hit ? (float16)(-1.0f) : p->t_max;
#else
    best->t = hit ? t : best->t;
    best->u = hit ? u : best->u;
    best->v = hit ? v : best->v;
    p->t_max = hit ? t : p->t_max;
#endif
    return true;
}

/* Tests the Triangles of a leaf; true when the packet's bounds have changed. */
static inline bool test_leaf16(const TraceScene* scene, const PacketInstance* instance, Packet* p,
                               PacketHit* best, int leaf) {
    const uint bits = (uint)~leaf;
    global const Triangle* first =
        (global const Triangle*)scene->triangles + (bits >> MACULA_LEAF_COUNT_BITS);
    global const Triangle* end = first + (bits & MACULA_LEAF_MAX);
    bool changed = false;
    /* Nearly always one turn: neighbouring rays have the same dominant axis. */
    for (uint axes = p->axes; axes != 0u; axes &= axes - 1u) {
        const uint kz = axes & 1u ? 0u : (axes & 2u ? 1u : 2u);
        for (global const Triangle* tri = first; tri != end; ++tri) {
            PacketEdges edges;
            int16 hit = cross_edges(p, tri, kz, &edges);
#if MACULA_ANY_HIT
            hit &= p->t_max >= 0.0f;
#endif
            if ((p->axes & (p->axes - 1u)) != 0u)
                hit &= p->kz == (int16)((int)kz);
            if (any_lane16(hit))
                changed |= finish_triangle(scene, instance, p, best, tri, &edges, hit);
        }
    }
    return changed;
}

#endif
