/* What lies behind the hits of a work-item's lanes: instances, corners of triangles, materials. */
#ifndef MACULA_SHADE_CORNERS_H
#define MACULA_SHADE_CORNERS_H

#include "lib/lane_memory.h"
#include "lib/surface.h"
#include "shared/bvh.h"
#include "shared/surface.h"

/* The instance that owns a scene-wide triangle id: the last one whose first id is not above it. */
static inline Uint instance_of_triangle(global const Instance* instances, uint count,
                                        Uint triangle) {
    Uint low = splat_uint(0u);
    uint step = 1u;
    while (step < count)
        step *= 2u;
    for (step /= 2u; step > 0u; step /= 2u) {
        const Uint next = low + step;
        const Uint kept = next < count ? next : splat_uint(0u);
        const Uint first = MACULA_GATHER(uint, instances, kept, .first_triangle);
        const Mask before = (next < count) & (first <= triangle);
        low = before ? next : low;
    }
    return low;
}

/* An Instance is a row of twelve float4, of which each matrix takes three. */
MACULA_ALWAYS_INLINE LaneMatrix load_matrix(global const Instance* instances, Uint instance,
                                            uint first_row) {
    LaneMatrix m;
    for (uint row = 0u; row < 3u; ++row) {
        const Lane4 v =
            gather4((global const float4*)instances, instance * 12u + (first_row + row));
        m.row[row] = v.xyz;
        m.shift[row] = v.w;
    }
    return m;
}

MACULA_ALWAYS_INLINE Placement load_placement(global const Instance* instances, Uint instance) {
    Placement placement;
    placement.identity = MACULA_GATHER(uint, instances, instance, .identity) != 0u;
    placement.moved = any_lane(!placement.identity);
    if (placement.moved) {
        placement.object_from_world = load_matrix(instances, instance, 0u);
        placement.world_from_object = load_matrix(instances, instance, 3u);
    }
    return placement;
}

/* world_from_object of the last frame. */
MACULA_ALWAYS_INLINE LaneMatrix load_previous(global const Instance* instances, Uint instance) {
    return load_matrix(instances, instance, 6u);
}

/* A SurfaceVertex is two float4: position and normal.x, the normal's rest and uv. */
MACULA_ALWAYS_INLINE SurfaceCorner load_corner(global const SurfaceVertex* vertices, Uint vertex) {
    global const float4* halves = (global const float4*)vertices;
    const Lane4 front = gather4(halves, vertex * 2u), back = gather4(halves, vertex * 2u + 1u);
    SurfaceCorner corner;
    corner.position = front.xyz;
    corner.normal = make3(front.w, back.xyz.x, back.xyz.y);
    corner.u = back.xyz.z;
    corner.v = back.w;
    return corner;
}

/* The corners of scene-wide triangles, and their materials. */
MACULA_ALWAYS_INLINE void load_corners(global const Instance* instances, Uint instance,
                                       global const SurfaceTriangle* triangles,
                                       global const SurfaceVertex* vertices, Uint triangle,
                                       SurfaceCorner* a, SurfaceCorner* b, SurfaceCorner* c,
                                       Uint* material) {
    const Uint base = MACULA_GATHER(uint, instances, instance, .mesh_triangle);
    const Uint scene_wide = MACULA_GATHER(uint, instances, instance, .first_triangle);
    const Lane4 t = gather4((global const float4*)triangles, base + (triangle - scene_wide));
    *a = load_corner(vertices, real_bits(t.xyz.x));
    *b = load_corner(vertices, real_bits(t.xyz.y));
    *c = load_corner(vertices, real_bits(t.xyz.z));
    *material = real_bits(t.w);
}

/* A SurfaceMaterial is four float4: a colour and its texture thrice, then shininess and the normal
 * map. */
MACULA_ALWAYS_INLINE Lane4 material_row(global const SurfaceMaterial* materials, Uint material,
                                        uint row) {
    return gather4((global const float4*)materials, material * 4u + row);
}

/* A SurfaceOptics is three float4. */
MACULA_ALWAYS_INLINE Lane4 optics_row(global const SurfaceOptics* optics, Uint material, uint row) {
    return gather4((global const float4*)optics, material * 3u + row);
}

#endif
