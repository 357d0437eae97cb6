/* Resolves hits into the G-buffer. Outputs that nobody reads are null. */
#include "lib/surface.h"
#include "shared/ray.h"

MACULA_ALWAYS_INLINE float2 motion_of(global const FrameParams* frame, float3 view,
                                      float3 previous_view) {
    float x, y, previous_x, previous_y;
    const bool seen = camera_project(&frame->camera, frame->width, frame->height, view, &x, &y) &&
                      camera_project(&frame->previous_camera, frame->width, frame->height,
                                     previous_view, &previous_x, &previous_y);
    return seen ? (float2)(clamped(previous_x - x, -MACULA_NO_MOTION, MACULA_NO_MOTION),
                           clamped(previous_y - y, -MACULA_NO_MOTION, MACULA_NO_MOTION))
                : (float2)(MACULA_NO_MOTION, MACULA_NO_MOTION);
}

MACULA_ALWAYS_INLINE float3 textured(const TextureTables* tables, global const float* colour,
                                     uint texture, const SurfacePoint* s, float lod) {
    const float3 base = vector_at(colour);
    return texture == MACULA_NO_TEXTURE ? base
                                        : base * sample_texture(tables, texture, s->u, s->v, lod);
}

/* The G-buffer, one entry a ray slot. A ray that missed has triangle MACULA_NO_TRIANGLE, zero
 * normals and albedo, and the background's radiance as its emission. */
typedef struct SurfaceOutputs {
    global float* depth;
    global float4* position;         /* xyz, w: distance to keep from the surface */
    global float4* geometric_normal; /* towards the viewer */
    global float4* shading_normal;
    global float4* albedo;
    global float4* specular; /* w: shininess */
    global float4* emission;
    global uint* triangle;
    global uint* material;
    global float2* motion; /* pixels: position in the last frame minus position in this one */
} SurfaceOutputs;

MACULA_ALWAYS_INLINE void write_background(const SurfaceOutputs* out, uint slot,
                                           global const FrameParams* frame, float3 direction) {
    const float4 zero = (float4)(0.0f);
    if (out->depth)
        out->depth[slot] = MACULA_BACKGROUND_DEPTH;
    if (out->position)
        out->position[slot] = zero;
    if (out->geometric_normal)
        out->geometric_normal[slot] = zero;
    if (out->shading_normal)
        out->shading_normal[slot] = zero;
    if (out->albedo)
        out->albedo[slot] = zero;
    if (out->specular)
        out->specular[slot] = (float4)(0.0f, 0.0f, 0.0f, 1.0f);
    if (out->emission)
        out->emission[slot] = (float4)(vector_at(frame->background), 0.0f);
    if (out->triangle)
        out->triangle[slot] = MACULA_NO_TRIANGLE;
    if (out->material)
        out->material[slot] = MACULA_NO_TRIANGLE;
    if (out->motion)
        out->motion[slot] = motion_of(frame, direction, direction);
}

MACULA_ALWAYS_INLINE void write_surface(const SurfaceOutputs* out, uint slot,
                                        global const FrameParams* frame, const SurfacePoint* s,
                                        const TextureTables* tables,
                                        global const SurfaceMaterial* material, float lod) {
    if (out->position)
        out->position[slot] = (float4)(s->position, s->offset);
    if (out->geometric_normal)
        out->geometric_normal[slot] = (float4)(s->geometric_normal, 0.0f);
    if (out->shading_normal) {
        const float3 normal =
            material->normal_texture == MACULA_NO_TEXTURE
                ? s->shading_normal
                : mapped_normal(s,
                                sample_texture(tables, material->normal_texture, s->u, s->v, lod));
        out->shading_normal[slot] = (float4)(normal, 0.0f);
    }
    if (out->albedo)
        out->albedo[slot] =
            (float4)(textured(tables, material->diffuse, material->diffuse_texture, s, lod), 0.0f);
    if (out->specular)
        out->specular[slot] =
            (float4)(textured(tables, material->specular, material->specular_texture, s, lod),
                     material->shininess);
    if (out->emission)
        out->emission[slot] =
            (float4)(textured(tables, material->emission, material->emission_texture, s, lod),
                     0.0f);
    if (out->material)
        out->material[slot] = s->material;
    if (out->motion)
        out->motion[slot] =
            motion_of(frame, s->position - vector_at(frame->camera.origin),
                      s->previous_position - vector_at(frame->previous_camera.origin));
}

/* One work-item a ray slot. */
kernel void resolve_surface(
    global const FrameParams* restrict frame, global const RayBlock* restrict rays,
    global const uint* restrict ray_count, global const HitBlock* restrict hits,
    global const Instance* restrict instances, uint instance_count,
    global const SurfaceTriangle* restrict triangles, global const SurfaceVertex* restrict vertices,
    global const SurfaceMaterial* restrict materials, global const ImageTexture* restrict textures,
    global const ImageLevel* restrict levels, global const uint* restrict texels,
    global const float* restrict decode, global float* restrict depth,
    global float4* restrict position, global float4* restrict geometric_normal,
    global float4* restrict shading_normal, global float4* restrict albedo,
    global float4* restrict specular, global float4* restrict emission,
    global uint* restrict triangle, global uint* restrict material,
    global float2* restrict motion) {
    const uint slot = get_global_id(0);
    if (slot >= *ray_count)
        return;
    const uint block = slot / MACULA_RAY_BLOCK, lane = slot % MACULA_RAY_BLOCK;
    const float3 direction = (float3)(rays[block].direction_x[lane], rays[block].direction_y[lane],
                                      rays[block].direction_z[lane]);
    const uint id = hits[block].triangle[lane];
    SurfaceOutputs out;
    out.depth = depth;
    out.position = position;
    out.geometric_normal = geometric_normal;
    out.shading_normal = shading_normal;
    out.albedo = albedo;
    out.specular = specular;
    out.emission = emission;
    out.triangle = triangle;
    out.material = material;
    out.motion = motion;
    if (id == MACULA_NO_TRIANGLE) {
        write_background(&out, slot, frame, direction);
        return;
    }
    const TextureTables tables = {textures, levels, texels, decode};
    const uint instance = instance_of_triangle(instances, instance_count, id);
    SurfacePoint s;
    surface_point(instances + instance, triangles, vertices, id, hits[block].u[lane],
                  hits[block].v[lane], direction, &s);
    /* t along a primary ray is the depth, and the cone's width grows with the depth. */
    const float t = hits[block].t[lane];
    const float lod = surface_lod(&s, t * frame->pixel_spread, direction);
    if (depth)
        depth[slot] = t;
    if (triangle)
        triangle[slot] = id;
    write_surface(&out, slot, frame, &s, &tables, materials + s.material, lod);
}
