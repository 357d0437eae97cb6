/* Transparency without an order of drawing (Krueger et al.'s K-buffer, as Mrad 2022, section 4.1.1
 * uses it): the layers of blended surfaces between a ray's origin and what it hits. The K nearest
 * are kept, by t and then by triangle; what lies behind them is merged into the last one, which
 * gets the opacity of all of them and keeps its own colour. */
#include "lib/instance.h"
#include "lib/texture.h"
#include "lib/traverse_binary.h"
#include "lib/traverse_queue.h"
#include "shade/corners.h"
#include "shade/queue.h"
#include "shared/camera.h"

/* Half a step of 8-bit alpha: what is less opaque is no layer. */
#define LEAST_OPACITY 0x1p-9f
#define NO_ROOT 0xffffffffu

typedef struct Layers {
    /* Of the blended geometry, in the layout `binary`, and of its surfaces. */
    global const BinaryNode* nodes;
    global const Triangle* triangles;
    global const Instance* instances;
    global const SurfaceTriangle* surface_triangles;
    global const SurfaceVertex* vertices;
    global const SurfaceOptics* optics;
    TextureTables textures;
    /* The buffer of this ray: t, u, v and opacity of each layer, and its triangle. */
    global float4* hits;
    global uint* ids;
    uint most;
    uint count;
    float behind; /* what goes through the layers that were merged */
    float width, growth; /* of the ray's cone: at its origin, and in a unit of t */
    float lod_bias;
    float3 direction;
} Layers;

static inline bool comes_before(float t, uint id, global const float4* hit, uint other) {
    return t < hit->x || (t == hit->x && id < other);
}

MACULA_ALWAYS_INLINE void insert_layer(Layers* l, float t, float u, float v, float opacity,
                                       uint id) {
    uint at = l->count;
    if (at == l->most) {
        const bool nearer = comes_before(t, id, l->hits + at - 1u, l->ids[at - 1u]);
        const float leaves = nearer ? l->hits[at - 1u].w : opacity;
        l->behind = l->behind * (1.0f - leaves);
        if (!nearer)
            return;
        --at;
    } else {
        ++l->count;
    }
    for (; at > 0u && comes_before(t, id, l->hits + at - 1u, l->ids[at - 1u]); --at) {
        l->hits[at] = l->hits[at - 1u];
        l->ids[at] = l->ids[at - 1u];
    }
    l->hits[at] = (float4)(t, u, v, opacity);
    l->ids[at] = id;
}

MACULA_ALWAYS_INLINE float layer_opacity(const Layers* l, uint instance, uint id, float t, float u,
                                         float v) {
    const Placement placement = load_placement(l->instances, instance);
    SurfaceCorner a, b, c;
    uint material;
    load_corners(l->instances, instance, l->surface_triangles, l->vertices, id, &a, &b, &c,
                 &material);
    const float opacity = l->optics[material].opacity;
    const uint texture = l->optics[material].opacity_texture;
    if (texture == MACULA_NO_TEXTURE)
        return opacity;
    SurfacePoint s;
    surface_point(&a, &b, &c, &placement, u, v, l->direction, &s);
    const float lod = surface_lod(&s, fma(t, l->growth, l->width), l->direction) + l->lod_bias;
    const uint shift = (texture & MACULA_ALPHA_CHANNEL) != 0u ? 24u : 0u;
    return opacity * sample_channel(&l->textures, texture & ~MACULA_ALPHA_CHANNEL, shift, s.u, s.v,
                                    lod);
}

/* From a to b the coordinates rise, the first that differs. */
static inline bool edge_rises(global const float* a, global const float* b) {
    if (a[0] != b[0])
        return a[0] < b[0];
    return a[1] != b[1] ? a[1] < b[1] : a[2] < b[2];
}

static inline bool hits_corners(const TraceRay* ray, global const float* a, global const float* b,
                                global const float* c, float* t, float* u, float* v) {
    return intersect_triangle(ray, a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2], t, u, v);
}

/* A hit right on an edge is one of the two triangles', or panes would show their diagonals:
 * neighbours go along their common edge in opposite directions, and that of rising coordinates has
 * it. The weight of the first corner is known exactly where it is another one's. */
static inline bool owns_hit(global const Triangle* tri, const TraceRay* ray, float u, float v) {
    if (u == 0.0f && !edge_rises(tri->v2, tri->v0))
        return false;
    if (v == 0.0f && !edge_rises(tri->v0, tri->v1))
        return false;
    if ((1.0f - u) - v > 0x1p-18f)
        return true;
    float t_again, weight, of_first = 1.0f;
    hits_corners(ray, tri->v1, tri->v2, tri->v0, &t_again, &weight, &of_first);
    return of_first != 0.0f || edge_rises(tri->v1, tri->v2);
}

MACULA_ALWAYS_INLINE void collect_leaf(Layers* l, const TraceRay* ray, const InstanceSpan* span,
                                       uint instance, int leaf) {
    const uint bits = (uint)~leaf;
    const uint first = bits >> MACULA_LEAF_COUNT_BITS;
    const uint end = first + (bits & MACULA_LEAF_MAX);
    for (uint i = first; i < end; ++i) {
        global const Triangle* tri = l->triangles + i;
        float t, u, v;
        if (!hits_corners(ray, tri->v0, tri->v1, tri->v2, &t, &u, &v) ||
            !clamp_to_span(span, &t) || !owns_hit(tri, ray, u, v))
            continue;
        const uint id = l->instances[instance].first_triangle + (tri->id & MACULA_ID_MASK);
        const float opacity = layer_opacity(l, instance, id, t, u, v);
        if (opacity >= LEAST_OPACITY)
            insert_layer(l, t, u, v, opacity, id);
    }
}

MACULA_ALWAYS_INLINE void collect_instance(Layers* l, const TraceRay* world, const QueuedRay* ray,
                                           uint index) {
    global const Instance* instance = l->instances + index;
    InstanceSpan span;
    if (!enter_instance(world, instance, &span))
        return;
    const TraceRay inside = transform_ray(instance, ray->ox, ray->oy, ray->oz, ray->dx, ray->dy,
                                          ray->dz, ray->t_min, ray->t_max);
    int stack[MACULA_BINARY_STACK];
    uint depth = 1u;
    stack[0] = MACULA_NO_CHILD;
    int node = instance->root;
    while (node != MACULA_NO_CHILD) {
        if (node >= 0) {
            node = descend(l->nodes + node, &inside, stack, &depth);
            continue;
        }
        collect_leaf(l, &inside, &span, index, node);
        node = stack[--depth];
    }
}

/* counts[slot]: layers found up to the hit, at most `most`; what goes through those behind them is
 * `behind`. meets[slot]: 0 where the ray meets none, whatever it hits. histogram[k]: rays with more
 * than k layers, begins as zeros. One work-item a slot. */
kernel void collect_layers(
    global const FrameParams* restrict frame, global const uchar* restrict nodes,
    global const uchar* restrict triangles, global const Instance* restrict instances,
    global const BinaryNode* restrict upper_nodes,
    global const SurfaceTriangle* restrict surface_triangles,
    global const SurfaceVertex* restrict vertices, global const SurfaceOptics* restrict optics,
    global const ImageTexture* restrict textures, global const ImageLevel* restrict levels,
    global const uint* restrict texels, global const float* restrict decode,
    global const RayBlock* restrict rays, global const uint* restrict ray_count,
    global const HitBlock* restrict found, global const float* restrict spreads,
    global const float4* restrict throughput, global const float4* restrict origin,
    global const uint* restrict meets, uint most, global float4* restrict hits,
    global uint* restrict ids, global uint* restrict counts, global float* restrict behind,
    global uint* restrict histogram) {
    const uint slot = (uint)get_global_id(0);
    if (slot >= *ray_count)
        return;
    counts[slot] = 0u;
    behind[slot] = 1.0f;
    if (meets[slot] == 0u)
        return;
    QueuedRay ray = load_ray(rays, slot);
    ray.t_max = found[slot / MACULA_RAY_BLOCK].t[slot % MACULA_RAY_BLOCK];
    Layers l;
    l.nodes = (global const BinaryNode*)nodes;
    l.triangles = (global const Triangle*)triangles;
    l.instances = instances;
    l.surface_triangles = surface_triangles;
    l.vertices = vertices;
    l.optics = optics;
    l.textures.textures = textures;
    l.textures.levels = levels;
    l.textures.texels = texels;
    l.textures.decode = decode;
    l.hits = hits + slot * most;
    l.ids = ids + slot * most;
    l.most = most;
    l.count = 0u;
    l.behind = 1.0f;
    l.width = throughput ? throughput[slot].w : 0.0f;
    l.growth = origin ? origin[slot].w : (spreads ? spreads[slot] : 1.0f) * frame->pixel_spread;
    l.lod_bias = frame->lod_bias;
    l.direction = make3(ray.dx, ray.dy, ray.dz);
    const TraceRay world =
        make_trace_ray(ray.ox, ray.oy, ray.oz, ray.dx, ray.dy, ray.dz, ray.t_min, ray.t_max);
    int stack[MACULA_BINARY_STACK];
    uint depth = 1u;
    stack[0] = MACULA_NO_CHILD;
    int node = 0;
    while (node != MACULA_NO_CHILD) {
        if (node >= 0) {
            node = descend(upper_nodes + node, &world, stack, &depth);
            continue;
        }
        collect_instance(&l, &world, &ray, (uint)~node >> MACULA_LEAF_COUNT_BITS);
        node = stack[--depth];
    }
    counts[slot] = l.count;
    behind[slot] = l.behind;
    for (uint k = 0u; k < l.count; ++k)
        atomic_inc(histogram + k);
}

/* From opacities to weights, front to back. Where all rays' layers are more than `capacity`, fewer
 * are kept of each, merged as above. through[slot]: what goes through all of them. flags[slot *
 * most + k] = 1 for each layer kept. One work-item a slot. */
kernel void weigh_layers(global const uint* restrict ray_count,
                         global const uint* restrict histogram, uint most, uint capacity,
                         global const uint* restrict counts, global const float* restrict behind,
                         global float4* restrict hits, global uint* restrict flags,
                         global uint* restrict flag_count, global float* restrict through) {
    const uint slot = (uint)get_global_id(0);
    if (slot == 0u)
        *flag_count = *ray_count * most;
    if (slot >= *ray_count)
        return;
    uint kept = 1u, total = histogram[0];
    while (kept < most && total + histogram[kept] <= capacity)
        total += histogram[kept++];
    const uint count = counts[slot], used = count < kept ? count : kept;
    float clear = 1.0f;
    for (uint k = 0u; k < used; ++k) {
        float passes = 1.0f - hits[slot * most + k].w;
        if (k + 1u == used) {
            for (uint merged = used; merged < count; ++merged)
                passes = passes * (1.0f - hits[slot * most + merged].w);
            passes = passes * behind[slot];
        }
        hits[slot * most + k].w = clear * (1.0f - passes);
        clear = clear * passes;
    }
    for (uint k = 0u; k < most; ++k)
        flags[slot * most + k] = k < used ? 1u : 0u;
    through[slot] = clear;
}

/* The layers as a list of rays with their hits, for the stages that shade surfaces. Entries of the
 * queue are indices of flags. The list's other parts are those of secondary rays (secondary.cl);
 * `last_...`: of the rays before whose hits the layers lie, null for primary ones.
 * One work-item an entry. */
kernel void list_layers(global const FrameParams* restrict frame, global const uint* restrict queue,
                        global const uint* restrict queue_count,
                        global const RayBlock* restrict last_rays,
                        global const uint* restrict last_pixels,
                        global const float* restrict spreads,
                        global const uint* restrict last_roots,
                        global const float4* restrict last_throughput,
                        global const float4* restrict last_origin, uint most,
                        global const float4* restrict layers, global const uint* restrict ids,
                        global RayBlock* restrict rays, global HitBlock* restrict hits,
                        global uint* restrict pixels, global uint* restrict roots,
                        global float4* restrict throughput, global float4* restrict origin,
                        global uint* restrict ray_count) {
    const uint entry = (uint)get_global_id(0), count = *queue_count;
    if (entry == 0u)
        *ray_count = padded_count(count);
    if (entry >= padded_count(count))
        return;
    const bool used = entry < count;
    const uint layer = used ? queue[entry] : 0u, slot = layer / most;
    const QueuedRay ray = load_ray(last_rays, slot);
    global RayBlock* block = rays + entry / MACULA_RAY_BLOCK;
    global HitBlock* hit = hits + entry / MACULA_RAY_BLOCK;
    const uint lane = entry % MACULA_RAY_BLOCK;
    block->origin_x[lane] = ray.ox;
    block->origin_y[lane] = ray.oy;
    block->origin_z[lane] = ray.oz;
    block->t_min[lane] = 0.0f;
    block->direction_x[lane] = ray.dx;
    block->direction_y[lane] = ray.dy;
    block->direction_z[lane] = ray.dz;
    block->t_max[lane] = -1.0f; /* traced already */
    const float4 at = used ? layers[layer] : (float4)(0.0f);
    hit->t[lane] = at.x;
    hit->u[lane] = at.y;
    hit->v[lane] = at.z;
    hit->triangle[lane] = used ? ids[layer] : MACULA_NO_TRIANGLE;
    const float growth =
        last_origin ? last_origin[slot].w : (spreads ? spreads[slot] : 1.0f) * frame->pixel_spread;
    const float4 whole = (float4)(1.0f, 1.0f, 1.0f, 0.0f);
    const float4 before = last_throughput ? last_throughput[slot] : whole;
    pixels[entry] = last_pixels[slot];
    roots[entry] = used ? (last_roots ? last_roots[slot] : slot) : NO_ROOT;
    throughput[entry] = (float4)(before.xyz * at.w, before.w);
    origin[entry] = (float4)(ray.ox, ray.oy, ray.oz, growth);
}

/* colour = what goes through the layers of a primary ray, and what they add; `through` is null for
 * those of secondary rays, whose throughput it changes instead. One work-item a layer; the first of
 * a slot adds them all, in their order. */
kernel void add_layers(global const uint* restrict ray_count, global const uint* restrict roots,
                       global const float4* restrict throughput,
                       global const float4* restrict colour, global const float* restrict through,
                       global float4* restrict total) {
    const uint first = (uint)get_global_id(0), count = *ray_count;
    if (first >= count)
        return;
    const uint root = roots[first];
    if (root == NO_ROOT || (first > 0u && roots[first - 1u] == root))
        return;
    float3 sum = total[root].xyz * (through ? through[root] : 1.0f);
    for (uint layer = first; layer < count && roots[layer] == root; ++layer)
        sum = fma3(throughput[layer].xyz, colour[layer].xyz, sum);
    total[root] = (float4)(sum, 1.0f);
}
