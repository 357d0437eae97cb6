/* Temporal upscaling: the picture gathers the samples of many frames of fewer pixels, whose jitter
 * puts them in ever other places (Yang et al. 2009 and 2020; Karis 2014). */
#include "lib/camera.h"
#include "lib/footprint.h"
#include "shared/planes.h"
#include "shared/surface.h"
#include "upscale/current.h"
#include "upscale/fovea.h"
#include "upscale/locks.h"
#include "upscale/nearness.h"
#include "upscale/neighbours.h"

#define MOVING_WORTH 4.0f /* samples that a colour can be worth while the view moves ... */
#define LOCKED_WORTH 8.0f /* ... and where a lock holds it */
#define STILL_WORTH 64.0f /* ... and while it stands still */
/* What the picture is worth that is but interpolated, where no sample lies near. */
#define GUESS 0.1f
/* Of a history beside a lock's life in one plane. */
#define LEAST_WORTH 0x1p-8f

/* What this frame's samples say of a pixel of the picture. */
typedef struct Current {
    Real3 sum;    /* of the samples within a pixel of it, by their weights */
    Real weight;  /* 0..1 */
    Real nearest; /* luma of the nearest sample */
    Mask within;  /* it lies within a pixel */
    Real trust;   /* what it is worth, at most 1 */
    Real3 smooth; /* between all samples around it */
    Neighbours around;
} Current;

/* `weighed`: the planes go on with how near to a pixel is what it was made of. */
static inline Current find_current(global const float* planes, uint pixels, bool weighed,
                                   const Source* s, float ratio_x, float ratio_y, Mask still) {
    const Weights3 across = quadratic_weights(s->to_x), down = quadratic_weights(s->to_y);
    const Weights3 near_x = tent_weights(s->to_x, ratio_x);
    const Weights3 near_y = tent_weights(s->to_y, ratio_y);
    const Real3 nothing = splat_vector(splat3(0.0f));
    const Real zero = splat(0.0f);
    Current c;
    c.sum = c.smooth = nothing;
    c.weight = zero;
    c.trust = splat(1.0f);
    c.around = no_neighbours();
    for (uint k = 0u; k < 9u; ++k) {
        const int i = (int)(k % 3u), j = (int)(k / 3u);
        const Real3 sample =
            make3(source_at(planes, s, i - 1, j - 1), source_at(planes + pixels, s, i - 1, j - 1),
                  source_at(planes + 2u * pixels, s, i - 1, j - 1));
        Worth worth = {near_x.w[i], near_y.w[j]};
        Real trust = splat(1.0f);
        if (weighed) {
            global const float* nearness = planes + MACULA_PLANE_NEARNESS * pixels;
            const Worth w = worth_of_nearness(source_at(nearness, s, i - 1, j - 1), still);
            trust = w.scale * w.amount;
            worth.scale = worth.scale * trust;
        }
        const Real weight = worth.scale * worth.amount;
        c.sum = scale_add3(sample, weight, c.sum);
        c.weight = fma(worth.scale, worth.amount, c.weight);
        c.smooth = scale_add3(sample, across.w[i] * down.w[j], c.smooth);
        add_neighbour(&c.around, sample);
        if (k == 4u) {
            c.nearest = luma_of(sample).x;
            c.within = weight > zero;
            c.trust = trust;
        }
    }
    c.smooth = make3(m_max(c.smooth.x, zero), m_max(c.smooth.y, zero), m_max(c.smooth.z, zero));
    weigh_nine(&c.around);
    return c;
}

/* The picture of the last frame. */
typedef struct Past {
    Real3 colour;
    Real worth; /* 0: nothing */
    Lock lock;
} Past;

static inline Past find_past(global const float* picture, uint pixels, const Footprint* f,
                             global const float* dither, Mask wanted) {
    const CubicWeights across = cubic_weights_of(f->to_x), down = cubic_weights_of(f->to_y);
    const Real packed = nearest_tap(picture + MACULA_PLANE_WORTH * pixels, f);
    const Real life = life_of(packed), worth = worth_of(packed, life);
    Past p;
    p.colour = make3(plane_between(picture, f, &across, &down).value,
                     plane_between(picture + pixels, f, &across, &down).value,
                     plane_between(picture + 2u * pixels, f, &across, &down).value);
    const Mask sound = wanted & (worth > splat(0.0f)) &
                       (packed <= splat(MOST_PACKED)) &
                       (worth <= splat(STILL_WORTH)) & (fabs(p.colour.x) < splat(1e30f)) &
                       (fabs(p.colour.y) < splat(1e30f)) & (fabs(p.colour.z) < splat(1e30f));
    p.worth = sound ? worth : splat(0.0f);
    p.lock = find_lock(picture, pixels, f, dither, sound);
    p.colour = select3(sound, p.colour, splat_vector(splat3(0.0f)));
    return p;
}

/* Last frame's place of a strip. */
typedef struct Place {
    Real x, y;   /* pixels of the picture */
    Mask wanted; /* it had one */
    Real speed;  /* the larger component, pixels of the picture */
} Place;

static inline Place find_place(global const float* followed, uint pixels, const Strip* s,
                               const Source* source, float ratio_x, float ratio_y) {
    const Real motion_x = source_at(followed, source, 0, 0);
    const Real motion_y = source_at(followed + pixels, source, 0, 0);
    const Real x = motion_x * splat(ratio_x), y = motion_y * splat(ratio_y);
    Place p;
    p.x = fma(motion_x, splat(ratio_x), strip_middles(s));
    p.y = fma(motion_y, splat(ratio_y), splat((float)s->y + 0.5f));
    p.wanted = strip_inside(s) & (motion_x < splat(MACULA_NO_MOTION)) & (p.x > splat(0.0f)) &
               (p.y > splat(0.0f)) & (p.x < splat((float)s->width)) &
               (p.y < splat((float)s->height));
    p.speed = m_max(fabs(x), fabs(y));
    return p;
}

/* From the gaze: the disk, and so far around it that the next frame's cubic finds the neighbours of
 * what is in it: two pixels each way, at ratio 1. */
static inline float disk_reach(global const Fovea* fovea) {
    return fovea->radius + 3.0f;
}

/* One work-item a strip of the picture. planes: of what is rendered. thin: as of find_thin().
 * upscaled: six planes of the picture. fresh: 0 for pixels that are means of many frames' samples,
 * and thus without jitter; null where there are none. */
kernel void upscale(global const FrameParams* restrict frame, uint target_width, uint target_height,
                    uint beyond, global const Fovea* restrict fovea,
                    global const Fovea* restrict past_fovea, global const float* restrict planes,
                    global const float* restrict spreads, global const float* restrict thin,
                    global const float* restrict followed,
                    global const float* restrict past_upscaled,
                    global const float* restrict fresh, global float* restrict upscaled) {
    const Strip s = strip_of_item(target_width, target_height);
    if (s.y >= s.height)
        return;
    const int width = (int)frame->width, height = (int)frame->height;
    const uint pixels = frame->width * frame->height, all = target_width * target_height;
    const float across = m_divide((float)width, (float)s.width);
    const float down = m_divide((float)height, (float)s.height);
    if (beyond == MACULA_BEYOND_SMOOTH &&
        is_far_from_gaze(fovea, &s, across, down, disk_reach(fovea)))
        return;
    const float ratio_x = m_divide((float)s.width, (float)width);
    const float ratio_y = m_divide((float)s.height, (float)height);
    const Real one = splat(1.0f), zero = splat(0.0f);
    /* What surrounds the disk has no jitter. */
    Real share = one;
    Mask gathered = strip_inside(&s);
    if (beyond != MACULA_BEYOND_NOTHING) {
        const Real distance = distance_in_picture(fovea, &s, across, down);
        share = part_of_disk(fovea, distance);
        if (beyond == MACULA_BEYOND_SMOOTH)
            gathered = gathered & (distance < splat(disk_reach(fovea)));
    }
    if (!any_lane(gathered))
        return;
    if (fresh) {
        const Source nearest = source_of(&s, width, height, across, down, zero, zero);
        share = source_at(fresh, &nearest, 0, 0);
    }
    const Source source =
        source_of(&s, width, height, across, down, splat(frame->jitter[0]) * share,
                  splat(frame->jitter[1]) * share);
    Place place = find_place(followed, pixels, &s, &source, ratio_x, ratio_y);
    const Mask still = place.speed < splat(0x1p-8f);
    Current now = find_current(planes, pixels, beyond == MACULA_BEYOND_GATHER, &source, ratio_x,
                               ratio_y, still);
    if (beyond == MACULA_BEYOND_GATHER) {
        /* Without jitter some pixels of the picture never lie near a rendered one. */
        const Real even = (one - share) * now.trust;
        now.sum = scale_add3(now.sum, share, scale3(now.smooth, even));
        now.weight = fma(now.weight, share, even);
    }
    /* As large as the picture, and in the middle of its pixels: there is nothing to gather. */
    const bool complete = width == s.width && height == s.height && frame->jitter[0] == 0.0f &&
                          frame->jitter[1] == 0.0f;
    place.wanted = complete ? gathered & (one < zero) : gathered & place.wanted;
    if (beyond == MACULA_BEYOND_SMOOTH)
        place.wanted = place.wanted & was_gathered(past_fovea, place.x, place.y, across, down);
    Past past = {splat_vector(splat3(0.0f)), zero, {zero, zero, zero, zero}};
    if (any_lane(place.wanted)) {
        const Footprint f = footprint_at(place.x, place.y, place.wanted, s.width, s.height);
        past = find_past(past_upscaled, all, &f, frame->jitter, place.wanted);
    }
    const Real life = source_at(thin, &source, 0, 0);
    Mask seen = gathered & (life > zero) & now.within;
    Real beside = zero;
    if (any_lane(seen)) {
        beside = source_at(thin + pixels, &source, 0, 0);
        seen = seen & !outshone(&past.lock, now.nearest - beside);
    }
    const Mask holds = lock_holds(&past.lock, seen, beside, now.nearest, now.around.mean.x,
                                  now.around.deviation.x);
    const Real reach = still ? splat(STILL_REACH) : splat(MOVING_REACH);
    const Real kept =
        m_min(past.worth,
              still ? splat(STILL_WORTH) : (holds ? splat(LOCKED_WORTH) : splat(MOVING_WORTH)));
    const Real guess =
        m_divide(splat(GUESS) * now.trust * m_max(one - now.weight, zero), one + kept);
    const Real weight = now.weight + guess;
    const Real3 sample = scale3(scale_add3(now.smooth, guess, now.sum), m_divide(one, weight));
    Real slack = splat(1e-6f);
    if (beyond != MACULA_BEYOND_NOTHING)
        slack = m_max(slack, splat(SPREAD_REACH) * source_at(spreads, &source, 0, 0));
    Real3 history = rectified(&now.around, past.colour, reach, slack);
    history = select3(holds, past.colour, history);
    const Real worth = kept + weight;
    const Mask known = past.worth > zero;
    const Real3 mixed = lerp3(history, sample, m_divide(weight, worth));
    const Real3 result = select3(known, mixed, sample);
    store_plane(upscaled, &s, m_max(result.x, zero));
    store_plane(upscaled + all, &s, m_max(result.y, zero));
    store_plane(upscaled + 2u * all, &s, m_max(result.z, zero));
    const Lock next = next_lock(&past.lock, holds, seen, beside, now.nearest, life);
    const Real packed =
        fma(next.life, splat(LIFE_UNIT), clamped(worth, splat(LEAST_WORTH), splat(STILL_WORTH)));
    store_plane(upscaled + MACULA_PLANE_WORTH * all, &s, packed);
    if (any_lane(next.life > zero)) {
        store_plane(upscaled + MACULA_PLANE_GROUND * all, &s, next.ground);
        store_plane(upscaled + MACULA_PLANE_RIDGE * all, &s, next.ridge);
    }
}
