/* Temporal anti-aliasing (Mrad 2022, section 4.4; Yang et al. 2020): each pixel's colour is mixed
 * with what its surface showed in the last frames. */
#include "lib/camera.h"
#include "lib/cache_info.h"
#include "lib/footprint.h"
#include "shared/planes.h"
#include "shared/surface.h"
#include "upscale/fovea.h"
#include "upscale/nearness.h"
#include "upscale/neighbours.h"

#define LEAST_BIAS 0.1f   /* of the retention bias, section 4.4 */
#define MOST_WORTH 255.0f /* samples that a colour can be worth */

static inline Real3 finite_or(Real3 v, Real3 otherwise, Mask* is_finite) {
    *is_finite = (fabs(v.x) < splat(1e30f)) & (fabs(v.y) < splat(1e30f)) &
                 (fabs(v.z) < splat(1e30f));
    return select3(*is_finite, v, otherwise);
}

/* The same view as in the last frame. */
static inline bool stands_still(global const FrameParams* frame) {
    global const float *now = (global const float*)&frame->camera,
                       *then = (global const float*)&frame->previous_camera;
    bool same = true;
    for (uint k = 0u; k < sizeof(Camera) / sizeof(float); ++k)
        same = same && now[k] == then[k];
    return same;
}

/* Three by three colours; `light`: the sum of their luminance. */
static inline Neighbours find_neighbours(global const float4* colour, const Strip* s, Real* light) {
    Neighbours n = no_neighbours();
    Real sum = splat(0.0f);
    for (uint k = 0u; k < 9u; ++k) {
        const Real3 c = colours_at(colour, s, (int)(k % 3u) - 1, (int)(k / 3u) - 1).xyz;
        sum = sum + luminance_of(c);
        add_neighbour(&n, c);
    }
    weigh_nine(&n);
    *light = sum;
    return n;
}

/* What the last frame showed. */
typedef struct Past {
    Real3 colour, mean;
    Real worth; /* 0: nothing */
} Past;

static inline Past find_past(global const float* stable, uint pixels, const Footprint* f,
                             Mask wanted) {
    const CubicWeights across = cubic_weights_of(f->to_x), down = cubic_weights_of(f->to_y);
    const Between r = plane_between(stable, f, &across, &down);
    const Between g = plane_between(stable + pixels, f, &across, &down);
    const Between b = plane_between(stable + 2u * pixels, f, &across, &down);
    const Real worth = nearest_tap(stable + MACULA_PLANE_WORTH * pixels, f);
    const Real3 nothing = splat_vector(splat3(0.0f));
    Mask sound, sound_mean;
    Past past;
    past.colour = finite_or(make3(r.value, g.value, b.value), nothing, &sound);
    past.mean = finite_or(make3(r.mean, g.mean, b.mean), nothing, &sound_mean);
    const Mask known = wanted & sound & sound_mean & (worth > splat(0.0f)) &
                       (worth <= splat(MOST_WORTH));
    past.worth = known ? worth : splat(0.0f);
    return past;
}

/* Equations 4.8 to 4.10. `change`: of the mean luminance around the pixel, beyond what its samples
 * vary by; `motion`: in pixels. */
static inline Real retention_bias(global const FrameParams* frame, Real change, Real motion,
                                  float frame_rate) {
    const float width = (float)frame->width, height = (float)frame->height;
    const float diagonal = m_sqrt(fma(width, width, height * height));
    const float pace = m_divide(60.0f, frame_rate);
    const Real speed = m_sqrt(m_sqrt(motion * splat(m_divide(1.0f, diagonal)))) * splat(pace);
    const Real least = clamped(change, splat(LEAST_BIAS), splat(1.0f)), rest = splat(1.0f) - least;
    return fma(rest, clamped(speed, splat(0.0f), splat(1.0f)), least);
}

/* What a history may be worth for a sample of 1 to have the share `bias`. */
static inline Real most_worth(Real bias) {
    const Real share = clamped(bias, splat(1e-3f), splat(1.0f));
    return m_divide(splat(1.0f) - share, share);
}

/* One work-item a strip. colour: alpha says how near a sample lies to the pixel, 0..1.
 * stable: four planes, colour and worth; colour_out may be null. `fovea`: null, or the disk within
 * which nothing is smoothed. spreads: the deviation of the luminance of the samples that a pixel is
 * made of. */
kernel void antialias(global const FrameParams* restrict frame, float frame_rate,
                      global const Fovea* restrict fovea, global const float4* restrict colour,
                      global const float* restrict spreads, global const float* restrict followed,
                      global const float* restrict past_stable, global float* restrict stable,
                      global float4* restrict colour_out) {
    const Strip s = strip_of_item(frame->width, frame->height);
    if (s.y >= s.height)
        return;
    const uint pixels = frame->width * frame->height;
    const Lane4 pixel = colours_at(colour, &s, 0, 0);
    const Real3 now = pixel.xyz;
    const Real motion_x = plane_at(followed, &s, 0, 0);
    const Real motion_y = plane_at(followed + pixels, &s, 0, 0);
    const Real one = splat(1.0f);
    const Real disk = fovea ? part_of_disk(fovea, distance_to_gaze(fovea, &s)) : splat(0.0f);
    const Mask wanted = strip_inside(&s) & (fabs(motion_x) < splat(MACULA_NO_MOTION)) &
                        (disk < one);
    Real3 result = now;
    const Real near = m_max(pixel.w, splat(LEAST_NEARNESS));
    Real worth = near;
    if (any_lane(wanted)) {
        const Footprint f = footprint_at(strip_middles(&s) + motion_x,
                                         ((float)s.y + 0.5f) + motion_y, wanted, s.width,
                                         s.height);
        const Past past = find_past(past_stable, pixels, &f, wanted);
        const Real spread = plane_at(spreads, &s, 0, 0);
        Real light;
        const Neighbours around = find_neighbours(colour, &s, &light);
        const Real apart = fabs(fma(light, splat(NINTH), -luminance_of(past.mean)));
        const Real motion = m_sqrt(fma(motion_x, motion_x, motion_y * motion_y));
        const Mask still = (motion < splat(0x1p-9f)) & splat_mask(stands_still(frame));
        const Real3 history = rectified(&around, past.colour, still ? splat(STILL_REACH)
                                                                      : splat(MOVING_REACH),
                                        m_max(splat(SPREAD_REACH) * spread, splat(1e-6f)));
        const Real noise = splat(SPREAD_REACH) * m_max(spread, around.deviation.x);
        const Real change = m_max(apart - noise, splat(0.0f));
        Real bias = retention_bias(frame, change, motion, frame_rate);
        bias = still ? change : bias;
        const Real kept = m_min(past.worth, most_worth(bias));
        const Worth sample = worth_of_nearness(near, still);
        const Real sum = fma(sample.scale, sample.amount, kept);
        /* The disk's own samples, towards its middle. */
        const Real part = m_divide(sample.scale * sample.amount, sum);
        bias = fma(one - part, disk, part);
        const Mask mixed = wanted & (past.worth > splat(0.0f)) & (bias < one);
        result = select3(mixed, lerp3(history, now, bias), now);
        worth = mixed ? m_min(sum, splat(MOST_WORTH)) : near;
    }
    store_plane(stable, &s, result.x);
    store_plane(stable + pixels, &s, result.y);
    store_plane(stable + 2u * pixels, &s, result.z);
    store_plane(stable + MACULA_PLANE_WORTH * pixels, &s, worth);
    if (colour_out)
        store_colours(colour_out, &s, result);
}

/* Colours as planes, for what reads them so: where nothing is smoothed before. `weighed`: 1: alpha
 * is a fourth one. */
kernel void split_colour(uint width, uint height, uint weighed,
                         global const float4* restrict colour, global float* restrict planes) {
    const Strip s = strip_of_item(width, height);
    if (s.y >= s.height)
        return;
    const uint pixels = width * height;
    const Lane4 now = colours_at(colour, &s, 0, 0);
    store_plane(planes, &s, now.xyz.x);
    store_plane(planes + pixels, &s, now.xyz.y);
    store_plane(planes + 2u * pixels, &s, now.xyz.z);
    if (weighed != 0u)
        store_plane(planes + MACULA_PLANE_NEARNESS * pixels, &s, now.w);
}
