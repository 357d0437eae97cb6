/* From a hit to the surface at the hit point: position, normals, texture footprint. Every lane has
 * a hit of its own. */
#ifndef MACULA_LIB_SURFACE_H
#define MACULA_LIB_SURFACE_H

#include "lib/lanes.h"

MACULA_SHARED_BEGIN

/* Secondary rays start this part of the largest coordinate involved above the surface: eight units
 * in the last place, more than the rounding of the position and of the triangle test together. */
#define MACULA_SURFACE_OFFSET 0x1p-20f

typedef struct SurfacePoint {
    Real3 object;             /* position in the space of the mesh */
    Real3 position;           /* world space, of this frame */
    Real offset;              /* distance to keep from the surface, world units */
    Real3 geometric_normal;   /* unit, towards the viewer's side */
    Mask behind;              /* the viewer is on the side that the triangle's winding calls back */
    Real3 shading_normal;     /* unit, on the side of the geometric one; before normal mapping */
    Real3 tangent, bitangent; /* world vectors along rising u and v, unit; zero without uv */
    Real u, v;
    Real log2_density; /* log2(texture area / world area) / 2 of the triangle */
} SurfacePoint;

/* Rows of a 3 x 4 matrix. */
typedef struct LaneMatrix {
    Real3 row[3];
    Real shift[3];
} LaneMatrix;

MACULA_ALWAYS_INLINE Real3 transform_vector(const LaneMatrix* m, Real3 v) {
    return make3(dot3(m->row[0], v), dot3(m->row[1], v), dot3(m->row[2], v));
}

/* x * a.x + (y * a.y + (z * a.z + b)), each with one rounding. */
MACULA_ALWAYS_INLINE Real dot_add(Real3 a, Real3 v, Real b) {
    return fma(a.x, v.x, fma(a.y, v.y, fma(a.z, v.z, b)));
}

MACULA_ALWAYS_INLINE Real3 transform_point(const LaneMatrix* m, Real3 p) {
    return make3(dot_add(m->row[0], p, m->shift[0]), dot_add(m->row[1], p, m->shift[1]),
                 dot_add(m->row[2], p, m->shift[2]));
}

/* Normals go by the transpose of the inverse: m is object_from_world. */
MACULA_ALWAYS_INLINE Real3 transform_normal(const LaneMatrix* m, Real3 n) {
    return make3(dot3(make3(m->row[0].x, m->row[1].x, m->row[2].x), n),
                 dot3(make3(m->row[0].y, m->row[1].y, m->row[2].y), n),
                 dot3(make3(m->row[0].z, m->row[1].z, m->row[2].z), n));
}

MACULA_ALWAYS_INLINE Real3 absolute3(Real3 v) {
    return make3(fabs(v.x), fabs(v.y), fabs(v.z));
}

/* The sizes of the terms that a transformed point is summed from; `size`: of the point's. */
MACULA_ALWAYS_INLINE Real3 transform_size(const LaneMatrix* m, Real3 size) {
    return make3(dot_add(absolute3(m->row[0]), size, fabs(m->shift[0])),
                 dot_add(absolute3(m->row[1]), size, fabs(m->shift[1])),
                 dot_add(absolute3(m->row[2]), size, fabs(m->shift[2])));
}

/* A corner of a triangle, in the space of the mesh. */
typedef struct SurfaceCorner {
    Real3 position, normal;
    Real u, v;
} SurfaceCorner;

/* Where the mesh of a lane stands. */
typedef struct Placement {
    Mask identity; /* where it holds, the matrices are not looked at */
    bool moved;    /* some lane's is no identity: else the matrices are not even set */
    LaneMatrix world_from_object, object_from_world;
} Placement;

/* A placement that mirrors turns the winding of triangles around. */
MACULA_ALWAYS_INLINE Mask mirrors(const Placement* placement) {
    const LaneMatrix* m = &placement->world_from_object;
    const Real volume = dot3(cross3(m->row[0], m->row[1]), m->row[2]);
    return !placement->identity & (volume < splat(0.0f));
}

/* Edges and uv differences of a triangle. */
typedef struct SurfaceEdges {
    Real3 e1, e2; /* world space */
    Real du1, dv1, du2, dv2;
    Real uv_area; /* twice the signed area in the texture */
} SurfaceEdges;

MACULA_ALWAYS_INLINE void surface_tangents(const SurfaceEdges* c, SurfacePoint* s) {
    const Real3 zero = splat_vector(splat3(0.0f));
    const Real sign = c->uv_area < splat(0.0f) ? splat(-1.0f) : splat(1.0f);
    const Real3 along_u = fma3(c->e1, splat3(c->dv2), neg3(scale3(c->e2, c->dv1)));
    const Real3 along_v = fma3(c->e2, splat3(c->du1), neg3(scale3(c->e1, c->du2)));
    s->tangent = unit3(scale3(along_u, sign), zero);
    s->bitangent = unit3(scale3(along_v, sign), zero);
}

/* Akenine-Moeller et al. 2019, equation 2, with the texture's own size left to the look-up. */
MACULA_ALWAYS_INLINE Real surface_log2_density(Real uv_area, Real world_area) {
    const Real least = splat(1e-30f), one = splat(1.0f);
    const Mask sized = (uv_area > least) & (world_area > least);
    const Real log2_uv = m_log2(sized ? uv_area : one);
    const Real log2_world = m_log2(sized ? world_area : one);
    return sized ? 0.5f * (log2_uv - log2_world)
                 : splat(-60.0f); /* no texture coordinates: the finest level */
}

MACULA_ALWAYS_INLINE void surface_texture(const SurfaceCorner* a, const SurfaceCorner* b,
                                          const SurfaceCorner* c, Real hit_u, Real hit_v,
                                          SurfaceEdges* edges, SurfacePoint* s) {
    edges->du1 = b->u - a->u;
    edges->dv1 = b->v - a->v;
    edges->du2 = c->u - a->u;
    edges->dv2 = c->v - a->v;
    edges->uv_area = fma(edges->du1, edges->dv2, -(edges->du2 * edges->dv1));
    s->u = fma(edges->du1, hit_u, fma(edges->du2, hit_v, a->u));
    s->v = fma(edges->dv1, hit_u, fma(edges->dv2, hit_v, a->v));
}

MACULA_ALWAYS_INLINE void surface_normals(const SurfaceCorner* a, const SurfaceCorner* b,
                                          const SurfaceCorner* c, Real hit_u, Real hit_v,
                                          Real3 direction, const Placement* placement,
                                          Real3 scaled_normal, SurfacePoint* s) {
    const Real3 upwards = splat_vector(make3(0.0f, 0.0f, 1.0f));
    const Real3 flat_normal = unit3(scaled_normal, unit3(neg3(direction), upwards));
    const Mask away = dot3(flat_normal, direction) > splat(0.0f);
    s->geometric_normal = select3(away, neg3(flat_normal), flat_normal);
    s->behind = placement->moved ? away != mirrors(placement) : away;
    const Real weight_a = (1.0f - hit_u) - hit_v;
    const Real3 blended =
        scale_add3(a->normal, weight_a, scale_add3(b->normal, hit_u, scale3(c->normal, hit_v)));
    const Real3 in_world = placement->moved
                               ? select3(placement->identity, blended,
                                         transform_normal(&placement->object_from_world, blended))
                               : blended;
    const Real3 normal = unit3(in_world, s->geometric_normal);
    const Mask below = dot3(normal, s->geometric_normal) < splat(0.0f);
    s->shading_normal = select3(below, neg3(normal), normal);
}

/* Sets position, offset and edges. */
MACULA_ALWAYS_INLINE void surface_position(const SurfaceCorner* a, const SurfaceCorner* b,
                                           const SurfaceCorner* c, Real hit_u, Real hit_v,
                                           const Placement* placement, SurfaceEdges* edges,
                                           SurfacePoint* s) {
    const Real3 e1 = sub3(b->position, a->position), e2 = sub3(c->position, a->position);
    const Real3 size =
        make3(m_max(m_max(fabs(a->position.x), fabs(b->position.x)), fabs(c->position.x)),
              m_max(m_max(fabs(a->position.y), fabs(b->position.y)), fabs(c->position.y)),
              m_max(m_max(fabs(a->position.z), fabs(b->position.z)), fabs(c->position.z)));
    s->object = scale_add3(e1, hit_u, scale_add3(e2, hit_v, a->position));
    edges->e1 = e1;
    edges->e2 = e2;
    s->position = s->object;
    Real3 summands = size;
    if (placement->moved) {
        const LaneMatrix* world = &placement->world_from_object;
        const Mask same = placement->identity;
        edges->e1 = select3(same, e1, transform_vector(world, e1));
        edges->e2 = select3(same, e2, transform_vector(world, e2));
        s->position = select3(same, s->object, transform_point(world, s->object));
        summands = select3(same, size, transform_size(world, size));
    }
    s->offset = MACULA_SURFACE_OFFSET * largest3(summands);
}

/* `hit_u`, `hit_v`: barycentric weights of b and c. `direction`: of the ray, any length. */
MACULA_ALWAYS_INLINE void surface_point(const SurfaceCorner* a, const SurfaceCorner* b,
                                        const SurfaceCorner* c, const Placement* placement,
                                        Real hit_u, Real hit_v, Real3 direction, SurfacePoint* s) {
    SurfaceEdges edges;
    surface_position(a, b, c, hit_u, hit_v, placement, &edges, s);
    const Real3 scaled_normal = cross3(edges.e1, edges.e2);
    surface_normals(a, b, c, hit_u, hit_v, direction, placement, scaled_normal, s);
    surface_texture(a, b, c, hit_u, hit_v, &edges, s);
    const Real area = m_sqrt(dot3(scaled_normal, scaled_normal));
    s->log2_density = surface_log2_density(fabs(edges.uv_area), area);
    surface_tangents(&edges, s);
}

/* log2 of the ray cone's footprint in units of the whole image: the cone's width at the hit over
 * the cosine of incidence, times the triangle's texel density. */
MACULA_ALWAYS_INLINE Real surface_lod(const SurfacePoint* s, Real cone_width, Real3 direction) {
    const Real squared = dot3(direction, direction);
    const Real cosine = fabs(dot3(s->geometric_normal, direction)) * m_inverse_sqrt(squared);
    const Real width = clamped(cone_width, splat(1e-18f), splat(1e18f));
    return s->log2_density + m_log2(width) - m_log2(m_max(cosine, splat(1e-4f)));
}

/* The normal of a tangent-space map turned into the world, kept above the geometric surface. */
MACULA_ALWAYS_INLINE Real3 mapped_normal(const SurfacePoint* s, Real3 texel) {
    const Real3 n = s->shading_normal;
    const Real3 m = scale_add3(texel, splat(2.0f), splat_vector(splat3(-1.0f)));
    const Real3 bent = scale_add3(s->tangent, m.x, scale_add3(s->bitangent, m.y, scale3(n, m.z)));
    const Real3 unit = unit3(bent, n);
    return select3(dot3(unit, s->geometric_normal) > splat(0.0f), unit, n);
}

MACULA_SHARED_END
#endif
