/* From a hit to the surface at the hit point: position, normals, texture footprint. */
#ifndef MACULA_LIB_SURFACE_H
#define MACULA_LIB_SURFACE_H

#include "lib/camera.h"
#include "lib/texture.h"
#include "shared/bvh.h"

MACULA_SHARED_BEGIN

/* Secondary rays start this part of the largest coordinate involved above the surface: eight units
 * in the last place, more than the rounding of the position and of the triangle test together. */
#define MACULA_SURFACE_OFFSET 0x1p-20f

typedef struct SurfacePoint {
    float3 position;           /* world space, of this frame */
    float3 previous_position;  /* the same point of the object in the last frame */
    float offset;              /* distance to keep from the surface, world units */
    float3 geometric_normal;   /* unit, towards the viewer's side */
    float3 shading_normal;     /* unit, on the side of the geometric one; before normal mapping */
    float3 tangent, bitangent; /* world vectors along rising u and v, unit; zero without uv */
    float u, v;
    float log2_density; /* log2(texture area / world area) / 2 of the triangle */
    uint material;
} SurfacePoint;

MACULA_ALWAYS_INLINE float3 transform_vector(MACULA_GLOBAL const float* m, float3 v) {
    return make3(fma(m[0], v.x, fma(m[1], v.y, m[2] * v.z)),
                 fma(m[4], v.x, fma(m[5], v.y, m[6] * v.z)),
                 fma(m[8], v.x, fma(m[9], v.y, m[10] * v.z)));
}

MACULA_ALWAYS_INLINE float3 transform_point(MACULA_GLOBAL const float* m, float3 p) {
    return make3(fma(m[0], p.x, fma(m[1], p.y, fma(m[2], p.z, m[3]))),
                 fma(m[4], p.x, fma(m[5], p.y, fma(m[6], p.z, m[7]))),
                 fma(m[8], p.x, fma(m[9], p.y, fma(m[10], p.z, m[11]))));
}

/* Normals go by the transpose of the inverse: m is object_from_world. */
MACULA_ALWAYS_INLINE float3 transform_normal(MACULA_GLOBAL const float* m, float3 n) {
    return make3(fma(m[0], n.x, fma(m[4], n.y, m[8] * n.z)),
                 fma(m[1], n.x, fma(m[5], n.y, m[9] * n.z)),
                 fma(m[2], n.x, fma(m[6], n.y, m[10] * n.z)));
}

/* The sizes of the terms that a transformed point is summed from. */
MACULA_ALWAYS_INLINE float3 transform_size(MACULA_GLOBAL const float* m, float3 p) {
    return make3(fma(fabs(m[0]), p.x, fma(fabs(m[1]), p.y, fma(fabs(m[2]), p.z, fabs(m[3])))),
                 fma(fabs(m[4]), p.x, fma(fabs(m[5]), p.y, fma(fabs(m[6]), p.z, fabs(m[7])))),
                 fma(fabs(m[8]), p.x, fma(fabs(m[9]), p.y, fma(fabs(m[10]), p.z, fabs(m[11])))));
}

MACULA_ALWAYS_INLINE float3 largest_of_three(float3 a, float3 b, float3 c) {
    return make3(m_max(m_max(fabs(a.x), fabs(b.x)), fabs(c.x)),
                 m_max(m_max(fabs(a.y), fabs(b.y)), fabs(c.y)),
                 m_max(m_max(fabs(a.z), fabs(b.z)), fabs(c.z)));
}

/* The instance that owns a scene-wide triangle id: the last one whose first id is not above it. */
MACULA_ALWAYS_INLINE uint instance_of_triangle(MACULA_GLOBAL const Instance* instances, uint count,
                                               uint triangle) {
    uint low = 0u, high = count;
    while (high - low > 1u) {
        const uint middle = (low + high) / 2u;
        if (instances[middle].first_triangle <= triangle)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* Points, edges and uv differences of a triangle; filled and used within surface_point(). */
typedef struct SurfaceCorners {
    float3 p0, e1, e2; /* world space */
    float du1, dv1, du2, dv2;
    float uv_area; /* twice the signed area in the texture */
} SurfaceCorners;

MACULA_ALWAYS_INLINE void surface_tangents(const SurfaceCorners* c, SurfacePoint* s) {
    const float3 zero = make3(0.0f, 0.0f, 0.0f);
    const float sign = c->uv_area < 0.0f ? -1.0f : 1.0f;
    const float3 along_u = fma3(c->e1, splat3(c->dv2), -(c->e2 * c->dv1)) * sign;
    const float3 along_v = fma3(c->e2, splat3(c->du1), -(c->e1 * c->du2)) * sign;
    s->tangent = unit3(along_u, zero);
    s->bitangent = unit3(along_v, zero);
}

/* Akenine-Moeller et al. 2019, equation 2, with the texture's own size left to the look-up. */
MACULA_ALWAYS_INLINE float surface_log2_density(float uv_area, float world_area) {
    if (!(uv_area > 1e-30f) || !(world_area > 1e-30f))
        return -60.0f; /* no texture coordinates: the finest level */
    return 0.5f * (m_log2(uv_area) - m_log2(world_area));
}

/* `hit_u`, `hit_v`: barycentric weights of the second and third vertex. `direction`: of the ray,
 * any length. */
MACULA_ALWAYS_INLINE void surface_point(MACULA_GLOBAL const Instance* instance,
                                        MACULA_GLOBAL const SurfaceTriangle* triangles,
                                        MACULA_GLOBAL const SurfaceVertex* vertices, uint triangle,
                                        float hit_u, float hit_v, float3 direction,
                                        SurfacePoint* s) {
    const SurfaceTriangle t =
        triangles[instance->mesh_triangle + (triangle - instance->first_triangle)];
    MACULA_GLOBAL const SurfaceVertex* a = vertices + t.vertex[0];
    MACULA_GLOBAL const SurfaceVertex* b = vertices + t.vertex[1];
    MACULA_GLOBAL const SurfaceVertex* c = vertices + t.vertex[2];
    const bool identity = instance->identity != 0u;
    const float3 pa = vector_at(a->position), pb = vector_at(b->position);
    const float3 pc = vector_at(c->position);
    const float3 object = scale_add3(pb - pa, hit_u, scale_add3(pc - pa, hit_v, pa));
    const float3 size = largest_of_three(pa, pb, pc);
    SurfaceCorners corners;
    MACULA_GLOBAL const float* world = &instance->world_from_object[0][0];
    corners.e1 = identity ? pb - pa : transform_vector(world, pb - pa);
    corners.e2 = identity ? pc - pa : transform_vector(world, pc - pa);
    s->position = identity ? object : transform_point(world, object);
    s->previous_position = transform_point(&instance->previous_world_from_object[0][0], object);
    s->offset = MACULA_SURFACE_OFFSET * largest3(identity ? size : transform_size(world, size));

    const float3 scaled_normal = cross3(corners.e1, corners.e2);
    float3 normal = unit3(scaled_normal, unit3(-direction, make3(0.0f, 0.0f, 1.0f)));
    s->geometric_normal = dot3(normal, direction) > 0.0f ? -normal : normal;

    const float weight_a = (1.0f - hit_u) - hit_v;
    const float3 blended =
        scale_add3(vector_at(a->normal), weight_a,
                   scale_add3(vector_at(b->normal), hit_u, vector_at(c->normal) * hit_v));
    const float3 in_world =
        identity ? blended : transform_normal(&instance->object_from_world[0][0], blended);
    normal = unit3(in_world, s->geometric_normal);
    s->shading_normal = dot3(normal, s->geometric_normal) < 0.0f ? -normal : normal;

    corners.du1 = b->uv[0] - a->uv[0];
    corners.dv1 = b->uv[1] - a->uv[1];
    corners.du2 = c->uv[0] - a->uv[0];
    corners.dv2 = c->uv[1] - a->uv[1];
    corners.uv_area = fma(corners.du1, corners.dv2, -(corners.du2 * corners.dv1));
    s->u = fma(corners.du1, hit_u, fma(corners.du2, hit_v, a->uv[0]));
    s->v = fma(corners.dv1, hit_u, fma(corners.dv2, hit_v, a->uv[1]));
    s->log2_density =
        surface_log2_density(fabs(corners.uv_area), m_sqrt(dot3(scaled_normal, scaled_normal)));
    surface_tangents(&corners, s);
    s->material = t.material;
}

/* log2 of the ray cone's footprint in units of the whole image: the cone's width at the hit over
 * the cosine of incidence, times the triangle's texel density. */
MACULA_ALWAYS_INLINE float surface_lod(const SurfacePoint* s, float cone_width, float3 direction) {
    const float squared = dot3(direction, direction);
    const float cosine = fabs(dot3(s->geometric_normal, direction)) * m_inverse_sqrt(squared);
    const float width = clamped(cone_width, 1e-18f, 1e18f);
    return s->log2_density + m_log2(width) - m_log2(m_max(cosine, 1e-4f));
}

/* The normal of a tangent-space map turned into the world, kept above the geometric surface. */
MACULA_ALWAYS_INLINE float3 mapped_normal(const SurfacePoint* s, float3 texel) {
    const float3 n = s->shading_normal;
    const float3 m = scale_add3(texel, 2.0f, splat3(-1.0f));
    const float3 bent = scale_add3(s->tangent, m.x, scale_add3(s->bitangent, m.y, n * m.z));
    const float3 unit = unit3(bent, n);
    return dot3(unit, s->geometric_normal) > 0.0f ? unit : n;
}

MACULA_SHARED_END
#endif
