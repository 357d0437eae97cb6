/* Where each pixel's surface was in the last frame, for what gathers samples over frames: no motion
 * where that frame saw another surface there (Yang et al. 2020, section 5.1, and section 3.2 for
 * the nearest neighbour's motion). OpenCL C only. */
#ifndef MACULA_UPSCALE_FOLLOW_H
#define MACULA_UPSCALE_FOLLOW_H

#include "lib/camera.h"
#include "lib/footprint.h"
#include "shared/planes.h"
#include "shared/surface.h"
#include "upscale/normals.h"

/* Part by which a depth may differ from what it is expected to be. */
#define DEPTH_TOLERANCE 0.1f
/* Depths from here on are the background's. */
#define FAR_AWAY 1e29f

/* The nearest of three by three surfaces: the edge of what is in front moves with it. */
typedef struct Nearest {
    Real depth, motion_x, motion_y;
} Nearest;

static inline Nearest nearest_surface(global const float* surfaces, uint pixels, const Strip* s) {
    Nearest n;
    n.depth = plane_at(surfaces + MACULA_PLANE_DEPTH * pixels, s, 0, 0);
    n.motion_x = plane_at(surfaces + MACULA_PLANE_MOTION_X * pixels, s, 0, 0);
    n.motion_y = plane_at(surfaces + MACULA_PLANE_MOTION_Y * pixels, s, 0, 0);
    for (uint k = 0u; k < 9u; ++k) {
        const int dx = (int)(k % 3u) - 1, dy = (int)(k / 3u) - 1;
        const Real depth = plane_at(surfaces + MACULA_PLANE_DEPTH * pixels, s, dx, dy);
        const Mask closer = depth < n.depth;
        if (!any_lane(closer))
            continue;
        const Real x = plane_at(surfaces + MACULA_PLANE_MOTION_X * pixels, s, dx, dy);
        const Real y = plane_at(surfaces + MACULA_PLANE_MOTION_Y * pixels, s, dx, dy);
        n.depth = closer ? depth : n.depth;
        n.motion_x = closer ? x : n.motion_x;
        n.motion_y = closer ? y : n.motion_y;
    }
    return n;
}

/* Pixels of motion between an edge and what is behind it. */
#define SEAM_MOTION 0.25f
/* Pixels of motion that are no rounding, where only what moves by itself counts. */
#define OWN_MOTION 0.0625f

/* The depth beside the nearest one that the next frame may look for: the pixel's own, unless its
 * history went with the nearest surface, which moves otherwise. What is uncovered there must not
 * find it. */
static inline Real seam_depth(const Nearest* nearest, Real own, Real motion_x, Real motion_y) {
    const Real apart =
        m_max(fabs(nearest->motion_x - motion_x), fabs(nearest->motion_y - motion_y));
    return apart > splat(SEAM_MOTION) ? nearest->depth : own;
}

/* The depth that the surface had in the last frame if it stood still. */
static inline Real past_depth(global const FrameParams* frame, const Strip* s, Real depth) {
    global const Camera *now = &frame->camera, *then = &frame->previous_camera;
    const float3 forward = vector_at(then->forward);
    const float3 moved = sub3(vector_at(now->origin), vector_at(then->origin));
    const float step_x = m_divide(now->tan_right + now->tan_left, (float)s->width);
    const float step_y = m_divide(now->tan_up + now->tan_down, (float)s->height);
    const float along_x = dot3(vector_at(now->right), forward);
    const float along_y = dot3(vector_at(now->up), forward);
    const float sy = fma((float)s->y + 0.5f, -step_y, now->tan_up);
    const float at_left = fma(along_x, -now->tan_left,
                              fma(along_y, sy, dot3(vector_at(now->forward), forward)));
    const Real slope = fma(strip_middles(s), splat(along_x * step_x), splat(at_left));
    const Real past = fma(depth, slope, splat(dot3(moved, forward)));
    return depth >= splat(FAR_AWAY) ? depth : past;
}

/* Depths that a history may have. */
typedef struct Depths {
    Real least, most;
} Depths;

/* A strip's places in the last frame, and what faced the viewer there. */
typedef struct Before {
    Mask same;   /* it holds a depth near those that are looked for */
    Real facing; /* a packed normal */
} Before;

/* past_range: planes of the last frame. */
static inline Before find_before(global const FrameParams* frame, const Strip* s, Real motion_x,
                                 Real motion_y, Depths depths, global const float* past_range) {
    const uint pixels = frame->width * frame->height;
    const Real x = strip_middles(s) + motion_x;
    const Real y = splat((float)s->y + 0.5f) + motion_y;
    const Mask seen = strip_inside(s) & (x > splat(0.0f)) & (y > splat(0.0f)) &
                      (x < splat((float)s->width)) & (y < splat((float)s->height));
    Before before = {seen, splat(0.0f)};
    if (any_lane(seen)) {
        const Footprint f = footprint_at(x, y, seen, s->width, s->height);
        const Real past_least = nearest_tap(past_range + MACULA_PLANE_LEAST * pixels, &f);
        const Real past_most = nearest_tap(past_range + MACULA_PLANE_MOST * pixels, &f);
        before.facing = nearest_tap(past_range + MACULA_PLANE_FACING * pixels, &f);
        const Mask reaches = past_depth(frame, s, depths.least) <=
                             past_most * splat(1.0f + DEPTH_TOLERANCE);
        const Mask begins = past_depth(frame, s, depths.most) >=
                            past_least * splat(1.0f - DEPTH_TOLERANCE);
        /* Before the first frame all depths are 0. */
        before.same = seen & reaches & begins & (past_most > splat(0.0f));
    }
    return before;
}

/* So far that a surface can have come into view. At rest only the jitter changes normals. */
static inline Mask moves(Real motion_x, Real motion_y) {
    return m_max(fabs(motion_x), fabs(motion_y)) > splat(SEAM_MOTION);
}

/* What faced the viewer in the last frame still does: at the pixel, or at one of those around it,
 * whose edges the jitter moves. */
static inline Mask still_faces(global const float* normals, const Strip* s, Real facing,
                               Mask wanted) {
    const Real own = plane_at(normals, s, 0, 0);
    Mask alike = own == facing;
    if (any_lane(wanted & !alike))
        alike = face_alike(own, facing);
    for (uint k = 0u; k < 9u && any_lane(wanted & !alike); ++k) {
        const int dx = (int)(k % 3u) - 1, dy = (int)(k / 3u) - 1;
        alike = alike | face_alike(plane_at(normals, s, dx, dy), facing);
    }
    return alike;
}

/* Writes two planes of motion in pixels, MACULA_NO_MOTION for what has no history. */
static inline void store_followed(const Strip* s, Real motion_x, Real motion_y, Mask same,
                                  global float* followed) {
    const Real none = splat(MACULA_NO_MOTION);
    store_plane(followed, s, same ? motion_x : none);
    store_plane(followed + (uint)(s->width * s->height), s, same ? motion_y : none);
}

#endif
