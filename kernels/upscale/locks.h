/* Locks of thin features: where a sample hit a thing thinner than what is rendered, the history
 * holds it though the next frames' samples miss it. OpenCL C only. */
#ifndef MACULA_UPSCALE_LOCKS_H
#define MACULA_UPSCALE_LOCKS_H

#include "lib/footprint.h"
#include "shared/planes.h"

/* Frames that a lock lasts at most without its thing being seen. */
#define MOST_LIFE 64.0f
/* What is beside a lock may have come so far, of its contrast, from what it was ... */
#define GROUND_AWAY 0.25f
/* ... towards the thing, whose other samples are counted with it, and the thing itself. */
#define GROUND_TOWARDS 0.6f
#define RIDGE_CHANGE 0.5f

/* Life and worth go in one plane. */
#define LIFE_UNIT 128.0f
#define MOST_PACKED ((MOST_LIFE + 1.0f) * LIFE_UNIT)

typedef struct Lock {
    Real life;   /* frames; 0: there is none */
    Real around; /* the same, or that of one beside it */
    Real ground; /* luma beside the thing */
    Real ridge;  /* its own */
} Lock;

MACULA_ALWAYS_INLINE Real life_of(Real packed) {
    return floor(packed * splat(m_divide(1.0f, LIFE_UNIT)));
}

MACULA_ALWAYS_INLINE Real worth_of(Real packed, Real life) {
    return fma(life, splat(-LIFE_UNIT), packed);
}

/* The four pixels around a place. */
typedef struct Corners {
    Real v[4];
} Corners;

MACULA_ALWAYS_INLINE Corners corners_at(global const float* plane, const Footprint* f) {
    Corners c;
    if (f->exact) {
        c.v[0] = c.v[1] = c.v[2] = c.v[3] = tap_of(plane, f, 0, 0);
        return c;
    }
    for (int k = 0; k < 4; ++k)
        c.v[k] = tap_of(plane, f, k & 1, k >> 1);
    return c;
}

/* Which of them. */
typedef struct Corner {
    Mask right, below;
} Corner;

MACULA_ALWAYS_INLINE Real corner_of(const Corners* c, const Corner* at) {
    const Real upper = at->right ? c->v[1] : c->v[0], lower = at->right ? c->v[3] : c->v[2];
    return at->below ? lower : upper;
}

/* The nearest would be the same one in every frame of a slow motion, and locks would stay behind.
 * `dither`, in [-0.5, 0.5), takes each as often as the place lies near it. */
MACULA_ALWAYS_INLINE Corner dithered_corner(const Footprint* f, global const float* dither) {
    const Corner c = {f->to_x > splat(dither[0] + 0.5f), f->to_y > splat(dither[1] + 0.5f)};
    return c;
}

/* The lock of the last frame at a place, or else one beside it: what is read between pixels holds
 * some of theirs. */
MACULA_ALWAYS_INLINE Lock find_lock(global const float* picture, uint pixels, const Footprint* f,
                                    global const float* dither, Mask known) {
    const Real zero = splat(0.0f);
    Lock lock = {zero, zero, zero, zero};
    Corners lives = corners_at(picture + MACULA_PLANE_WORTH * pixels, f);
    for (uint k = 0u; k < 4u; ++k) {
        Mask sound = known & (lives.v[k] > zero) & (lives.v[k] <= splat(MOST_PACKED));
        /* Nothing is read from those that the place does not lie towards. */
        if ((k & 1u) != 0u)
            sound = sound & (f->to_x > zero);
        if ((k >> 1) != 0u)
            sound = sound & (f->to_y > zero);
        lives.v[k] = sound ? life_of(lives.v[k]) : zero;
    }
    const Real upper = m_max(lives.v[0], lives.v[1]), lower = m_max(lives.v[2], lives.v[3]);
    if (!any_lane(m_max(upper, lower) > zero))
        return lock;
    Corner at = dithered_corner(f, dither);
    lock.life = corner_of(&lives, &at);
    const Mask none = lock.life <= zero;
    at.below = none ? lower > upper : at.below;
    at.right = none ? (at.below ? lives.v[3] > lives.v[2] : lives.v[1] > lives.v[0]) : at.right;
    lock.around = corner_of(&lives, &at);
    const Corners grounds = corners_at(picture + MACULA_PLANE_GROUND * pixels, f);
    const Corners ridges = corners_at(picture + MACULA_PLANE_RIDGE * pixels, f);
    lock.ground = corner_of(&grounds, &at);
    lock.ridge = corner_of(&ridges, &at);
    const Mask sound = (fabs(lock.ground) < splat(1e30f)) & (fabs(lock.ridge) < splat(1e30f));
    lock.life = sound ? lock.life : zero;
    lock.around = sound ? lock.around : zero;
    return lock;
}

/* By a lock: a thing of much less contrast is a mark of what lies around it. */
MACULA_ALWAYS_INLINE Mask outshone(const Lock* lock, Real contrast) {
    return (lock->around > splat(0.0f)) &
           (fabs(contrast) < splat(RIDGE_CHANGE) * fabs(lock->ridge - lock->ground));
}

/* What it stands for is still there, as far as this frame's samples tell. `thin`: the luma beside
 * the thing where it is `seen`, whose own is `middle`. */
MACULA_ALWAYS_INLINE Mask lock_holds(const Lock* lock, Mask seen, Real thin, Real middle, Real mean,
                                     Real deviation) {
    const Real contrast = lock->ridge - lock->ground;
    const Real gone = (seen ? thin : mean) - lock->ground, part = gone * contrast;
    const Real square = contrast * contrast;
    const Mask same_ground = (fabs(gone) <= deviation) | ((part >= splat(-GROUND_AWAY) * square) &
                                                          (part <= splat(GROUND_TOWARDS) * square));
    const Real change = fabs(middle - lock->ridge);
    const Mask same_ridge = !seen | (change <= splat(RIDGE_CHANGE) * fabs(contrast));
    return (lock->around > splat(0.0f)) & same_ground & same_ridge;
}

/* For the next frame. */
MACULA_ALWAYS_INLINE Lock next_lock(const Lock* lock, Mask holds, Mask seen, Real thin, Real middle,
                                    Real life) {
    const Real quarter = splat(0.25f), left = m_max(lock->life - splat(1.0f), splat(0.0f));
    const Real ground = fma(quarter, thin - lock->ground, lock->ground);
    const Real ridge = fma(quarter, middle - lock->ridge, lock->ridge);
    Lock next;
    next.around = splat(0.0f);
    next.life = seen ? life : (holds ? left : splat(0.0f));
    next.ground = seen ? (holds ? ground : thin) : lock->ground;
    next.ridge = seen ? (holds ? ridge : middle) : lock->ridge;
    return next;
}

#endif
