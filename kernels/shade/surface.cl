/* Resolves hits into the G-buffer. Outputs that nobody reads are null. */
#include "lib/camera.h"
#include "lib/simd.h"
#include "lib/texture.h"
#include "shade/corners.h"
#include "shared/ray.h"

/* The G-buffer, one entry a ray slot. A ray that missed has triangle MACULA_NO_TRIANGLE, zero
 * normals and albedo, and the background's radiance as its emission. */
typedef struct SurfaceOutputs {
    global float* depth;
    global float4* position;         /* xyz, w: distance to keep from the surface */
    global float4* geometric_normal; /* towards the viewer; w: 1 on the back of a triangle */
    global float4* shading_normal;
    global float4* albedo;
    global float4* specular; /* w: shininess */
    global float4* emission;
    global uint* triangle;
    global uint* material;
    global float2* motion; /* pixels: position in the last frame minus position in this one */
} SurfaceOutputs;

/* The hits of a work-item's lanes, and what is behind them. */
typedef struct Hits {
    uint first; /* slot */
    Mask hit;
    Uint triangle; /* 0 where nothing is hit */
    Real t, u, v;
    Real3 direction;
} Hits;

/* Blocks are too long for the hardware to see where the next reads go; those of the work-items
 * after these are asked for early. */
#define FETCH_AHEAD 6u

static inline void fetch_hits(global const RayBlock* ray, global const HitBlock* found) {
    MACULA_FETCH(ray->direction_x, 0u);
    MACULA_FETCH(ray->direction_y, 0u);
    MACULA_FETCH(ray->direction_z, 0u);
    MACULA_FETCH(found->t, 0u);
    MACULA_FETCH(found->triangle, 0u);
    MACULA_FETCH(found->u, 0u);
    MACULA_FETCH(found->v, 0u);
}

static inline Hits load_hits(global const RayBlock* rays, global const HitBlock* hits, uint first,
                             uint ray_count) {
    global const RayBlock* ray = rays + first / MACULA_RAY_BLOCK;
    global const HitBlock* found = hits + first / MACULA_RAY_BLOCK;
    const uint lane = first % MACULA_RAY_BLOCK;
    fetch_hits(ray + FETCH_AHEAD, found + FETCH_AHEAD);
    const Uint triangle = load_uints(found->triangle, lane);
    Hits h;
    h.first = first;
    h.hit = (lanes_from(first) < ray_count) & (triangle != MACULA_NO_TRIANGLE);
    h.triangle = h.hit ? triangle : splat_uint(0u);
    h.t = h.hit ? load_reals(found->t, lane) : splat(MACULA_BACKGROUND_DEPTH);
    h.u = h.hit ? load_reals(found->u, lane) : splat(0.0f);
    h.v = h.hit ? load_reals(found->v, lane) : splat(0.0f);
    h.direction = make3(load_reals(ray->direction_x, lane), load_reals(ray->direction_y, lane),
                        load_reals(ray->direction_z, lane));
    return h;
}

/* `view`, `previous_view`: from the cameras' origins. */
static inline void write_motion(global float2* motion, uint first, global const FrameParams* frame,
                                Real3 view, Real3 previous_view) {
    Real x, y, previous_x, previous_y;
    const Mask seen = camera_project(&frame->camera, frame->width, frame->height, view, &x, &y) &
                      camera_project(&frame->previous_camera, frame->width, frame->height,
                                     previous_view, &previous_x, &previous_y);
    const Real none = splat(MACULA_NO_MOTION), least = splat(-MACULA_NO_MOTION);
    store2(motion, first, seen ? clamped(previous_x - x, least, none) : none,
           seen ? clamped(previous_y - y, least, none) : none);
}

static inline void write_background(const SurfaceOutputs* out, const Hits* h,
                                    global const FrameParams* frame) {
    const Real zero = splat(0.0f);
    const Real3 nothing = splat_vector(splat3(0.0f));
    if (out->depth)
        store_reals(out->depth, h->first, h->t);
    if (out->position)
        store4(out->position, h->first, nothing, zero);
    if (out->geometric_normal)
        store4(out->geometric_normal, h->first, nothing, zero);
    if (out->shading_normal)
        store4(out->shading_normal, h->first, nothing, zero);
    if (out->albedo)
        store4(out->albedo, h->first, nothing, zero);
    if (out->specular)
        store4(out->specular, h->first, nothing, splat(1.0f));
    if (out->emission)
        store4(out->emission, h->first, splat_vector(vector_at(frame->background)), zero);
    if (out->triangle)
        store_uints(out->triangle, h->first, splat_uint(MACULA_NO_TRIANGLE));
    if (out->material)
        store_uints(out->material, h->first, splat_uint(MACULA_NO_TRIANGLE));
    if (out->motion)
        write_motion(out->motion, h->first, frame, h->direction, h->direction);
}

/* A colour times its texture. */
static inline Real3 textured(const TextureTables* tables, Mask hit, Real3 base, Uint texture,
                             const SurfacePoint* s, Real lod) {
    const Mask used = hit & (texture != MACULA_NO_TEXTURE);
    if (!any_lane(used))
        return base;
    const Uint index = used ? texture : splat_uint(0u);
    return select3(used, mul3(base, sample_texture(tables, index, s->u, s->v, lod)), base);
}

static inline Real3 bumped_normal(const TextureTables* tables, Mask hit, Uint texture,
                                  const SurfacePoint* s, Real lod) {
    const Mask used = hit & (texture != MACULA_NO_TEXTURE);
    if (!any_lane(used))
        return s->shading_normal;
    const Uint index = used ? texture : splat_uint(0u);
    const Real3 texel = sample_texture(tables, index, s->u, s->v, lod);
    return select3(used, mapped_normal(s, texel), s->shading_normal);
}

/* Geometry. Lanes without a hit get the background's values. */
static inline void write_geometry(const SurfaceOutputs* out, const Hits* h, const SurfacePoint* s,
                                  Uint material) {
    const Real zero = splat(0.0f);
    const Real3 nothing = splat_vector(splat3(0.0f));
    const Uint none = splat_uint(MACULA_NO_TRIANGLE);
    if (out->depth)
        store_reals(out->depth, h->first, h->t);
    if (out->position)
        store4(out->position, h->first, select3(h->hit, s->position, nothing),
               h->hit ? s->offset : zero);
    if (out->geometric_normal)
        store4(out->geometric_normal, h->first, select3(h->hit, s->geometric_normal, nothing),
               (h->hit & s->behind) ? splat(1.0f) : zero);
    if (out->triangle)
        store_uints(out->triangle, h->first, h->hit ? h->triangle : none);
    if (out->material)
        store_uints(out->material, h->first, h->hit ? material : none);
}

/* What the material and its textures decide. */
static inline void write_material(const SurfaceOutputs* out, const Hits* h, const SurfacePoint* s,
                                  const TextureTables* tables,
                                  global const SurfaceMaterial* materials, Uint material,
                                  global const float* background, Real lod) {
    const Real zero = splat(0.0f);
    const Real3 nothing = splat_vector(splat3(0.0f));
    const Lane4 diffuse = material_row(materials, material, 0u);
    const Lane4 specular = material_row(materials, material, 1u);
    const Lane4 emission = material_row(materials, material, 2u);
    const Lane4 rest = material_row(materials, material, 3u);
    if (out->shading_normal) {
        const Real3 normal = bumped_normal(tables, h->hit, real_bits(rest.xyz.y), s, lod);
        store4(out->shading_normal, h->first, select3(h->hit, normal, nothing), zero);
    }
    if (out->albedo) {
        const Real3 albedo = textured(tables, h->hit, diffuse.xyz, real_bits(diffuse.w), s, lod);
        store4(out->albedo, h->first, select3(h->hit, albedo, nothing), zero);
    }
    if (out->specular) {
        const Real3 colour = textured(tables, h->hit, specular.xyz, real_bits(specular.w), s, lod);
        store4(out->specular, h->first, select3(h->hit, colour, nothing),
               h->hit ? rest.xyz.x : splat(1.0f));
    }
    if (out->emission) {
        const Real3 colour = textured(tables, h->hit, emission.xyz, real_bits(emission.w), s, lod);
        store4(out->emission, h->first,
               select3(h->hit, colour, splat_vector(vector_at(background))), zero);
    }
}

/* The width of a sample's cone at depth 1; `spreads`: in pixels, null where all are one pixel. */
static inline Real spread_of(global const float* spreads, uint first,
                             global const FrameParams* frame) {
    const Real pixels = spreads ? load_reals(spreads, first) : splat(1.0f);
    return pixels * frame->pixel_spread;
}

/* The width of the cone at the hit. Of a primary ray: t is the depth, with which it grows. Of a
 * secondary one, which has unit direction: what it had at its origin and what the way adds. */
static inline Real cone_width(const Hits* h, global const float* spreads,
                              global const float4* throughput, global const float4* origin,
                              global const FrameParams* frame) {
    if (!origin)
        return h->t * spread_of(spreads, h->first, frame);
    return fma(h->t, load4(origin, h->first).w, load4(throughput, h->first).w);
}

/* One work-item for MACULA_LANES ray slots. */
kernel void resolve_surface(
    global const FrameParams* restrict frame, global const RayBlock* restrict rays,
    global const uint* restrict ray_count, global const HitBlock* restrict hits,
    global const Instance* restrict instances, uint instance_count,
    global const SurfaceTriangle* restrict triangles, global const SurfaceVertex* restrict vertices,
    global const SurfaceMaterial* restrict materials, global const ImageTexture* restrict textures,
    global const ImageLevel* restrict levels, global const uint* restrict texels,
    global const float* restrict decode, global const float* restrict spreads,
    global const float4* restrict throughput, global const float4* restrict origin,
    global float* restrict depth, global float4* restrict position,
    global float4* restrict geometric_normal, global float4* restrict shading_normal,
    global float4* restrict albedo, global float4* restrict specular,
    global float4* restrict emission, global uint* restrict triangle,
    global uint* restrict material, global float2* restrict motion) {
    const uint first = first_of_item();
    if (first >= *ray_count)
        return;
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
    const Hits h = load_hits(rays, hits, first, *ray_count);
    if (!any_lane(h.hit)) {
        write_background(&out, &h, frame);
        return;
    }
    const Uint instance = instance_of_triangle(instances, instance_count, h.triangle);
    const Placement placement = load_placement(instances, instance);
    Uint of_hit;
    SurfaceCorner a, b, c;
    load_corners(instances, instance, triangles, vertices, h.triangle, &a, &b, &c, &of_hit);
    SurfacePoint s;
    surface_point(&a, &b, &c, &placement, h.u, h.v, h.direction, &s);
    write_geometry(&out, &h, &s, of_hit);
    const Real width = cone_width(&h, spreads, throughput, origin, frame);
    const Real lod = surface_lod(&s, width, h.direction) + frame->lod_bias;
    const TextureTables tables = {textures, levels, texels, decode};
    write_material(&out, &h, &s, &tables, materials, of_hit, frame->background, lod);
    if (motion) {
        const LaneMatrix previous = load_previous(instances, instance);
        const Real3 now = splat_vector(vector_at(frame->camera.origin));
        const Real3 then = splat_vector(vector_at(frame->previous_camera.origin));
        write_motion(motion, first, frame, select3(h.hit, sub3(s.position, now), h.direction),
                     select3(h.hit, sub3(transform_point(&previous, s.object), then), h.direction));
    }
}
