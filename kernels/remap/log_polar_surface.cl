/* What the pixels of log-polar and log-rectilinear foveation show, for what gathers samples over
 * frames: where it was and how far away. Beyond the disk a sample stands for many pixels, and the
 * next frame's for others there: motion is the mean over the samples around a pixel, at edges over
 * those of what is in front, depth their range, and of normals there are sets. */
#include "shared/ray.h"
#include "upscale/follow.h"
#include "upscale/fovea.h"
#include "upscale/neighbours.h"

/* Where a strip's pixels lie in the buffer: in texels, 0 being the middle of the first one. */
typedef struct Place {
    Real column, row;
} Place;

/* 1 for the log-rectilinear buffer. */
#if MACULA_RECTANGULAR
#include "remap/places_rect.h"
#else
#include "remap/places_polar.h"
#endif

/* A depth. */
#define BEHIND_ALL 2e30f

/* Of three by three texels. */
typedef struct Sums {
    Real least, most;                  /* depths */
    Real near_x, near_y, far_x, far_y; /* motion of the nearest and of the farthest one */
    Real light, squares, count;        /* of their luminance */
    Real front, motion_x, motion_y, movable; /* of the nearest of those that were in view */
    Uint facing;                       /* a set of normals */
    Mask moving;                       /* one of them moves by itself */
} Sums;

static inline Sums no_texels(void) {
    const Real zero = splat(0.0f);
    const Sums sums = {splat(MACULA_BACKGROUND_DEPTH), zero, zero, zero, zero, zero, zero, zero,
                       zero, splat(BEHIND_ALL), zero, zero, zero, splat_uint(0u), zero < zero};
    return sums;
}

/* The edge of what is in front moves with it. */
static inline void add_motion(Sums* sums, Mask moved, Real3 surface) {
    const Real one = splat(1.0f), zero = splat(0.0f);
    const Mask closer = moved & (surface.x < sums->front * splat(1.0f - DEPTH_TOLERANCE));
    const Mask counts = moved & (surface.x <= sums->front * splat(1.0f + DEPTH_TOLERANCE));
    sums->motion_x = (closer ? zero : sums->motion_x) + (counts ? surface.y : zero);
    sums->motion_y = (closer ? zero : sums->motion_y) + (counts ? surface.z : zero);
    sums->movable = (closer ? zero : sums->movable) + (counts ? one : zero);
    sums->front = moved ? m_min(sums->front, surface.x) : sums->front;
}

static inline void add_texels(Sums* sums, Mask sampled, Real light, Lane4 texel) {
    const Real3 surface = texel.xyz;
    const Real one = splat(1.0f), zero = splat(0.0f), none = splat(MACULA_NO_MOTION);
    const Mask nearer = sampled & (surface.x <= sums->least);
    const Mask farther = sampled & (surface.x >= sums->most);
    sums->least = nearer ? surface.x : sums->least;
    sums->near_x = nearer ? surface.y : sums->near_x;
    sums->near_y = nearer ? surface.z : sums->near_y;
    sums->most = farther ? surface.x : sums->most;
    sums->far_x = farther ? surface.y : sums->far_x;
    sums->far_y = farther ? surface.z : sums->far_y;
    sums->light = sums->light + (sampled ? light : zero);
    sums->squares = sampled ? fma(light, light, sums->squares) : sums->squares;
    sums->count = sums->count + (sampled ? one : zero);
    const Mask moved = sampled & (fabs(surface.y) < none) & (fabs(surface.z) < none);
    add_motion(sums, moved, surface);
    sums->facing = sums->facing | to_uint(sampled ? fabs(texel.w) : zero);
    sums->moving = sums->moving | (sampled & (texel.w < zero));
}

/* Something moves by itself before or behind something else. */
static inline Mask is_seam(const Sums* s) {
    const Real apart = m_max(fabs(s->near_x - s->far_x), fabs(s->near_y - s->far_y));
    return s->moving & (apart > splat(OWN_MOTION));
}

/* The texels from an index on, of which `whole` says that none lies beyond the buffer. */
static inline Lane4 texels_from(global const float4* texels, uint first, bool whole, uint last) {
    return whole ? load4(texels, first) : gather4(texels, min(lanes_from(first), splat_uint(last)));
}

/* One work-item a strip of a row of texels. surfaces: as of place_surfaces(). ranges: the least and
 * the greatest depth of three by three texels, the negative of the set of their normals, and the
 * greatest depth that the next frame may look for: what is uncovered at a seam must not find the
 * history that went with the nearest. motions: the mean of the nearest surface's, at a seam the
 * nearest texel's; the deviation of the luminance; that surface's depth, or 0: none has a motion.
 * How the two sides of a seam differ is no noise, and what the one left behind on the other no
 * history.
 * Texels without a sample have colours whose alpha is 0. */
kernel void summarise_texels(global const LogPolarParams* restrict params,
                             global const Fovea* restrict fovea,
                             global const float4* restrict colours,
                             global const float4* restrict surfaces,
                             global float4* restrict ranges, global float4* restrict motions) {
    const Strip s = strip_of_item(params->width, params->height);
    const int needed = (int)fovea->first_column;
    if (s.y >= s.height || s.x + MACULA_LANES <= needed || needed >= s.width)
        return;
    const uint pitch = params->pitch, last = pitch * params->height - 1u;
    const bool whole = s.x + MACULA_LANES + 2 <= (int)pitch;
    const Real zero = splat(0.0f);
    Sums sums = no_texels();
    for (int k = 0; k < 9; ++k) {
        /* A row begins with an empty texel. */
        const Int i = strip_columns(&s) + k % 3;
        const uint from = row_of_texels(params, s.y + k / 3 - 1) * pitch + (uint)(s.x + k % 3);
        const Lane4 colour = texels_from(colours, from, whole, last);
        const Lane4 surface = texels_from(surfaces, from, whole, last);
        const Mask sampled = (i > needed) & (i <= s.width) & (colour.w > zero);
        /* Colours are stored times their weights. */
        const Real weight = sampled ? colour.w : splat(1.0f);
        const Real light = m_divide(luminance_of(colour.xyz), weight);
        add_texels(&sums, sampled, light, surface);
    }
    const Real one = splat(1.0f), share = m_divide(one, m_max(sums.count, one));
    const Real mean = sums.light * share;
    const Real spread = deviation_of(fma(-mean, mean, sums.squares * share));
    const Real moved = m_divide(one, m_max(sums.movable, one));
    const uint to = (uint)s.y * pitch + (uint)s.x + 1u;
    const Mask inside = strip_inside(&s);
    const Mask seam = is_seam(&sums);
    const Mask with_nearest = seam & (fabs(sums.near_x) < splat(MACULA_NO_MOTION));
    scatter4(ranges, lanes_from(to), inside,
             make3(sums.least, sums.most, -uint_to_real(sums.facing)),
             seam ? sums.least : sums.most);
    scatter4(motions, lanes_from(to), inside,
             make3(with_nearest ? sums.near_x : sums.motion_x * moved,
                   with_nearest ? sums.near_y : sums.motion_y * moved, seam ? zero : spread),
             sums.movable > zero ? sums.front : zero);
}

/* Where surfaces meet, this much nearer or farther is another one. */
#define OTHER_SURFACE_BEFORE 0.8f
#define OTHER_SURFACE_BEHIND 1.25f

/* Between two by two texels, of those that show a surface at that depth; those without motion count
 * nothing, and none at all: no motion. */
static inline Lane4 motion_at(global const LogPolarParams* params, global const float4* motions,
                              const Place* p, Real depth) {
    const Real left = floor(p->column), top = floor(p->row);
    const Real to_x = p->column - left, to_y = p->row - top;
    const Int column = to_int(left), row = to_int(top);
    const Int right = min(column + 1, splat_int((int)params->width - 1));
    const Real one = splat(1.0f), zero = splat(0.0f);
    const Real weights[4] = {(one - to_x) * (one - to_y), to_x * (one - to_y), (one - to_x) * to_y,
                             to_x * to_y};
    const Real closest = depth * splat(OTHER_SURFACE_BEFORE);
    const Real farthest = depth * splat(OTHER_SURFACE_BEHIND);
    Lane4 sum = {splat_vector(splat3(0.0f)), zero};
    for (int k = 0; k < 4; ++k) {
        const Lane4 texel =
            gather4(motions, texel_at(params, (k & 1) == 0 ? column : right, row + (k >> 1)));
        const Mask same = (texel.w > closest) & (texel.w < farthest);
        const Real weight = same ? weights[k] : zero;
        sum.xyz = scale_add3(texel.xyz, weight, sum.xyz);
        sum.w = sum.w + weight;
    }
    const Mask known = sum.w > splat(1e-3f);
    const Real share = m_divide(one, known ? sum.w : one), none = splat(MACULA_NO_MOTION);
    sum.xyz.x = known ? sum.xyz.x * share : none;
    sum.xyz.y = known ? sum.xyz.y * share : none;
    sum.xyz.z = sum.xyz.z * share;
    return sum;
}

/* What a strip shows: where it was, how far away, which way it faces. */
typedef struct Shown {
    Real motion_x, motion_y;
    Depths depths, kept; /* to look for in the last frame, and for the next one */
    Real facing, deviation; /* a normal, or the negative of a set of them */
} Shown;

static inline Shown show_texels(global const LogPolarParams* params, global const float4* ranges,
                                global const float4* motions, const Place* p) {
    const Uint nearest = texel_at(params, to_int(rint(p->column)), to_int(rint(p->row)));
    const Lane4 range = gather4(ranges, nearest);
    const Lane4 motion = motion_at(params, motions, p, range.xyz.x);
    const Depths depths = {range.xyz.x, range.xyz.y}, kept = {range.xyz.x, range.w};
    const Shown shown = {motion.xyz.x, motion.xyz.y, depths, kept, range.xyz.z, motion.xyz.z};
    return shown;
}

/* `within`: so far inside of the disk that all neighbours were sampled. */
static inline Shown show_pixels(global const float* sampled, uint pixels, const Strip* s,
                                Mask within) {
    const Nearest around = nearest_surface(sampled, pixels, s);
    const Real own = plane_at(sampled + MACULA_PLANE_DEPTH * pixels, s, 0, 0);
    const Real x = plane_at(sampled + MACULA_PLANE_MOTION_X * pixels, s, 0, 0);
    const Real y = plane_at(sampled + MACULA_PLANE_MOTION_Y * pixels, s, 0, 0);
    const Real nearest = within ? around.depth : own;
    const Real behind = within ? seam_depth(&around, own, x, y) : own;
    const Depths depths = {nearest, nearest}, kept = {nearest, behind};
    const Shown shown = {within ? around.motion_x : x,
                         within ? around.motion_y : y,
                         depths,
                         kept,
                         plane_at(sampled + MACULA_PLANE_NORMAL * pixels, s, 0, 0),
                         splat(0.0f)};
    return shown;
}

static inline Depths select_depths(Mask mask, Depths a, Depths b) {
    const Depths d = {mask ? a.least : b.least, mask ? a.most : b.most};
    return d;
}

static inline Shown select_shown(Mask mask, const Shown* a, const Shown* b) {
    const Shown shown = {mask ? a->motion_x : b->motion_x,
                         mask ? a->motion_y : b->motion_y,
                         select_depths(mask, a->depths, b->depths),
                         select_depths(mask, a->kept, b->kept),
                         mask ? a->facing : b->facing,
                         mask ? a->deviation : b->deviation};
    return shown;
}

/* One work-item a strip. sampled: depth, motion and normal of the disk. range, followed: as of
 * follow_surfaces(); spread: the deviation of the samples that a pixel is made of; 0: the disk. */
kernel void remap_surfaces(global const FrameParams* restrict frame,
                           global const LogPolarParams* restrict params,
                           global const Fovea* restrict fovea, global const float4* restrict ranges,
                           global const float4* restrict motions,
                           global const float* restrict sampled,
                           global const float* restrict past_range, global float* restrict range,
                           global float* restrict followed, global float* restrict spread) {
    const Strip s = strip_of_item(frame->width, frame->height);
    if (s.y >= s.height)
        return;
    const uint pixels = frame->width * frame->height;
    const Real distance = distance_to_gaze(fovea, &s), zero = splat(0.0f);
    const Mask inside = strip_inside(&s), beyond = distance >= splat(fovea->radius);
    /* At the disk's edge a pixel has neighbours that were not sampled. */
    const Mask within = distance < splat(fovea->radius - 1.5f);
    const bool some_beyond = any_lane(inside & beyond), some_within = any_lane(inside & !beyond);
    Shown shown = {zero, zero, {zero, zero}, {zero, zero}, zero, zero};
    if (some_beyond) {
        const Real x = strip_middles(&s) - splat(fovea->x);
        const Real y = splat(((float)s.y + 0.5f) - fovea->y);
        const Place p =
            place_in_buffer(frame, params, fovea, x, y, m_max(distance, splat(fovea->inner)));
        shown = show_texels(params, ranges, motions, &p);
    }
    if (some_within) {
        const Shown disk = show_pixels(sampled, pixels, &s, within);
        shown = select_shown(beyond, &shown, &disk);
    }
    store_plane(range + MACULA_PLANE_LEAST * pixels, &s, shown.kept.least);
    store_plane(range + MACULA_PLANE_MOST * pixels, &s, shown.kept.most);
    store_plane(range + MACULA_PLANE_FACING * pixels, &s, shown.facing);
    store_plane(spread, &s, shown.deviation);
    const Before before =
        find_before(frame, &s, shown.motion_x, shown.motion_y, shown.depths, past_range);
    Mask same = before.same;
    const Mask moved = moves(shown.motion_x, shown.motion_y), judged = same & within & moved;
    if (any_lane(judged))
        same = same & (!judged | still_faces(sampled + MACULA_PLANE_NORMAL * pixels, &s,
                                             before.facing, judged));
    /* Two frames' texels lie far apart: they tell nothing unless all of them do. */
    const Mask told = same & beyond & moved;
    if (any_lane(told))
        same = same & (!told | sets_meet(facing_set(shown.facing), facing_set(before.facing)));
    store_followed(&s, shown.motion_x, shown.motion_y, same, followed);
}
