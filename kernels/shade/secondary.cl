/* Whitted's reflected and refracted rays without recursion: the rays of one level are a list that
 * is made from the surfaces of the level before it. Rays of one pixel sample are neighbours in each
 * list, so that what they see is added up in a fixed order. */
#include "lib/optics.h"
#include "shade/corners.h"
#include "shade/queue.h"
#include "shared/camera.h"

/* A ray that adds less than this part of what it sees is left out (Hall and Greenberg 1983): a step
 * of an 8-bit picture. */
#define LEAST_WEIGHT 0x1p-8f
/* Of a hit's two rays the stronger one always has a place in the list. The others are sorted into
 * classes 1 .. WEAK_CLASSES by powers of two; the lowest go where the list is too short. */
#define WEAK_CLASSES 8u
#define STRONGER_RAY (WEAK_CLASSES + 1u)
#define NO_ROOT 0xffffffffu

/* The surface at which rays go on. */
typedef struct Meeting {
    Mask hit;
    Real3 direction; /* unit */
    Real length;     /* of the ray's direction before */
    Real3 geometric, shading;
    Mask behind;
    Uint material; /* 0 where nothing is hit */
} Meeting;

static inline Meeting meeting_of(Mask hit, Real3 direction, Lane4 geometric, Lane4 shading,
                                 Uint material) {
    const Real3 upwards = splat_vector(make3(0.0f, 0.0f, 1.0f));
    const Real3 along = select3(hit, direction, upwards);
    Meeting m;
    m.hit = hit;
    m.length = m_sqrt(dot3(along, along));
    m.direction = scale3(along, m_divide(splat(1.0f), m.length));
    m.geometric = select3(hit, geometric.xyz, upwards);
    m.shading = select3(hit, shading.xyz, upwards);
    m.behind = geometric.w > splat(0.0f);
    m.material = hit ? material : splat_uint(0u);
    return m;
}

static inline Continuation continuation_of(const Meeting* m, global const SurfaceOptics* optics) {
    const Lane4 mirror = optics_row(optics, m->material, 0u);
    const Lane4 glass = optics_row(optics, m->material, 1u);
    Continuation c;
    continue_ray(m->direction, m->geometric, m->shading, m->behind, mirror.xyz, glass.xyz, mirror.w,
                 &c);
    return c;
}

/* True where the material mirrors or refracts at all. */
static inline Mask goes_on(global const SurfaceOptics* optics, Mask hit, Uint material) {
    const Uint index = hit ? material : splat_uint(0u);
    const Lane4 mirror = optics_row(optics, index, 0u), glass = optics_row(optics, index, 1u);
    return largest3(add3(mirror.xyz, glass.xyz)) > splat(0.0f);
}

static inline Uint class_of(Real weight) {
    const Real exponent = floor(m_log2(m_max(weight, splat(LEAST_WEIGHT))));
    return to_uint(clamped(exponent + (float)(WEAK_CLASSES + 1u), splat(1.0f),
                           splat((float)WEAK_CLASSES)));
}

/* flags[2 * slot] of the mirrored ray and flags[2 * slot + 1] of the refracted one: 0, or its class
 * of weight; histogram[class]: their number, begins as zeros. `throughput`: of the rays, null for
 * primary ones; `through`: what goes through the layers before their hits, null where there is
 * none. One work-item for MACULA_LANES slots of the launch. */
kernel void flag_secondary_rays(
    global const uint* restrict ray_count, global const RayBlock* restrict rays,
    global const uint* restrict triangle, global const uint* restrict material,
    global const float4* restrict geometric_normal, global const float4* restrict shading_normal,
    global const float4* restrict throughput, global const float* restrict through,
    global const SurfaceOptics* restrict optics, global uint* restrict flags,
    global uint* restrict flag_count,
    global uint* restrict histogram) {
    const uint first = first_of_item();
    if (first == 0u)
        *flag_count = 2u * *ray_count;
    if (beyond_list(*ray_count))
        return;
    const Uint none = splat_uint(0u);
    const Mask hit =
        (lanes_from(first) < *ray_count) & (load_uints(triangle, first) != MACULA_NO_TRIANGLE);
    Uint reflected = none, refracted = none;
    if (any_lane(hit & goes_on(optics, hit, load_uints(material, first)))) {
        const uint lane = first % MACULA_RAY_BLOCK;
        global const RayBlock* ray = rays + first / MACULA_RAY_BLOCK;
        const Real3 direction =
            make3(load_reals(ray->direction_x, lane), load_reals(ray->direction_y, lane),
                  load_reals(ray->direction_z, lane));
        const Meeting m = meeting_of(hit, direction, load4(geometric_normal, first),
                                     load4(shading_normal, first), load_uints(material, first));
        const Continuation c = continuation_of(&m, optics);
        const Real3 white = splat_vector(splat3(1.0f));
        Real3 before = throughput ? load4(throughput, first).xyz : white;
        before = through ? scale3(before, load_reals(through, first)) : before;
        const Real a = largest3(mul3(c.reflected_weight, before));
        const Real b = largest3(mul3(c.refracted_weight, before));
        const Uint strong = splat_uint(STRONGER_RAY);
        const Real least = splat(LEAST_WEIGHT);
        reflected = (hit & (a > least)) ? (a >= b ? strong : class_of(a)) : none;
        refracted = (hit & (b > least)) ? (a >= b ? class_of(b) : strong) : none;
        if (any_lane((reflected | refracted) != 0u))
            for (uint k = 1u; k <= STRONGER_RAY; ++k) {
                const uint count = count_lanes(reflected == k) + count_lanes(refracted == k);
                if (count > 0u)
                    atomic_add(histogram + k, count);
            }
    }
    store2_uints(flags, first, reflected, refracted);
}

/* From classes of weight to 0 and 1: the weakest are left out, class by class, until no more than
 * `capacity` rays are left. One work-item for MACULA_LANES flags of the launch. */
kernel void limit_secondary_rays(global const uint* restrict flag_count,
                                 global const uint* restrict histogram, uint capacity,
                                 global uint* restrict flags) {
    if (beyond_list(*flag_count))
        return;
    uint least = STRONGER_RAY, kept = histogram[STRONGER_RAY];
    while (least > 1u && kept + histogram[least - 1u] <= capacity) {
        --least;
        kept += histogram[least];
    }
    const uint first = first_of_item();
    const Uint flag = load_uints(flags, first);
    store_uints(flags, first, flag >= least ? splat_uint(1u) : splat_uint(0u));
}

/* Component `row` of a block of rays in memory, 0: origin_x. */
static inline Real gather_ray(global const RayBlock* rays, Uint slot, uint row) {
    global const float* words = (global const float*)rays;
    const Uint block = slot / MACULA_RAY_BLOCK;
    const Uint at = (block * 8u + row) * MACULA_RAY_BLOCK + slot % MACULA_RAY_BLOCK;
    return MACULA_GATHER(float, words, at, );
}

/* The queue's entries are indices of flags. throughput: the weight of the ray in its pixel sample;
 * w: the width of its cone at the origin, of which w of `origin` is the growth in a unit of length:
 * that of the ray before it, as if all surfaces were flat. Roots: the slots of the primary rays.
 * Of the rays before: `depth` is t at the hit, and `last_...` are null for primary rays, whose
 * footprints are `spreads` pixels, null: one. One work-item for MACULA_LANES entries. */
kernel void generate_secondary_rays(
    global const FrameParams* restrict frame, global const uint* restrict queue,
    global const uint* restrict queue_count, global const RayBlock* restrict last_rays,
    global const float* restrict spreads, global const uint* restrict last_pixels,
    global const uint* restrict last_roots, global const float4* restrict last_throughput,
    global const float* restrict last_through, global const float4* restrict last_origin,
    global const float* restrict depth, global const float4* restrict position,
    global const uint* restrict material, global const float4* restrict geometric_normal,
    global const float4* restrict shading_normal, global const SurfaceOptics* restrict optics,
    global RayBlock* restrict rays, global uint* restrict pixels, global uint* restrict roots,
    global float4* restrict throughput, global float4* restrict origin,
    global uint* restrict ray_count, global ulong* restrict ray_totals, uint ray_class) {
    const uint count = *queue_count, first = first_of_item();
    if (first == 0u) {
        *ray_count = padded_count(count);
        ray_totals[ray_class] += count;
    }
    if (first >= padded_count(count))
        return;
    const Mask used = lanes_from(first) < count;
    const Uint flag = used ? load_uints(queue, first) : splat_uint(0u);
    const Uint slot = flag / 2u;
    const Mask mirrored = (flag & 1u) == 0u;
    const Real3 direction = make3(gather_ray(last_rays, slot, 4u), gather_ray(last_rays, slot, 5u),
                                  gather_ray(last_rays, slot, 6u));
    const Meeting m = meeting_of(used, direction, gather4(geometric_normal, slot),
                                 gather4(shading_normal, slot),
                                 MACULA_GATHER(uint, material, slot, ));
    const Continuation c = continuation_of(&m, optics);
    const Lane4 surface = gather4(position, slot);
    const Real offset = mirrored ? surface.w : -surface.w;
    const Real3 from = scale_add3(m.geometric, offset, surface.xyz);
    const Real3 weight = select3(mirrored, c.reflected_weight, c.refracted_weight);

    const Real t = MACULA_GATHER(float, depth, slot, );
    Lane4 before = {splat_vector(splat3(1.0f)), splat(0.0f)};
    Real growth = splat(frame->pixel_spread);
    if (last_throughput) {
        before = gather4(last_throughput, slot);
        growth = gather4(last_origin, slot).w;
    } else if (spreads) {
        growth = MACULA_GATHER(float, spreads, slot, ) * frame->pixel_spread;
    }
    const Real width = fma(t, growth, before.w);
    store_rays(rays, first, from, select3(mirrored, c.reflected, c.refracted),
               used ? splat(MACULA_BACKGROUND_DEPTH) : splat(-1.0f));
    const Real3 arriving =
        last_through ? scale3(before.xyz, MACULA_GATHER(float, last_through, slot, )) : before.xyz;
    store4(throughput, first, mul3(arriving, weight), width);
    store4(origin, first, from, m_divide(growth, m.length));
    store_uints(pixels, first, MACULA_GATHER(uint, last_pixels, slot, ));
    const Uint root = last_roots ? MACULA_GATHER(uint, last_roots, slot, ) : slot;
    store_uints(roots, first, used ? root : splat_uint(NO_ROOT));
}

/* Adds what the rays of a level see to the colours of the primary rays' slots. One work-item a ray;
 * the first of a pixel sample's adds them all. */
kernel void add_secondary_rays(global const uint* restrict ray_count,
                               global const uint* restrict roots,
                               global const float4* restrict throughput,
                               global const float* restrict through,
                               global const float4* restrict colour,
                               global float4* restrict total) {
    const uint first = (uint)get_global_id(0), count = *ray_count;
    if (first >= count)
        return;
    const uint root = roots[first];
    if (root == NO_ROOT || (first > 0u && roots[first - 1u] == root))
        return;
    float3 sum = total[root].xyz;
    for (uint ray = first; ray < count && roots[ray] == root; ++ray) {
        const float3 weight = throughput[ray].xyz * (through ? through[ray] : 1.0f);
        sum = fma3(weight, colour[ray].xyz, sum);
    }
    total[root] = (float4)(sum, 1.0f);
}
