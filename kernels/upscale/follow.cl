/* Surfaces followed from frame to frame, for methods that sample each pixel. */
#include "upscale/follow.h"

/* One work-item a strip. followed: as store_followed() writes it. range: what the next frame
 * compares with: the nearest depth around a pixel, which moves an edge, and its own, or that behind
 * a thin thing; its normal, but for that one's. */
kernel void follow_surfaces(global const FrameParams* restrict frame,
                            global const float* restrict surfaces,
                            global const float* restrict past_range, global float* restrict range,
                            global float* restrict followed) {
    const Strip s = strip_of_item(frame->width, frame->height);
    if (s.y >= s.height)
        return;
    const uint pixels = frame->width * frame->height;
    const Nearest n = nearest_surface(surfaces, pixels, &s);
    const Real own = plane_at(surfaces + MACULA_PLANE_DEPTH * pixels, &s, 0, 0);
    const Real x = plane_at(surfaces + MACULA_PLANE_MOTION_X * pixels, &s, 0, 0);
    const Real y = plane_at(surfaces + MACULA_PLANE_MOTION_Y * pixels, &s, 0, 0);
    global const float* normals = surfaces + MACULA_PLANE_NORMAL * pixels;
    Mask thin;
    const Real behind = behind_thin(surfaces, pixels, &s, own, strip_inside(&s), &thin);
    const Depths depths = {n.depth, seam_depth(&n, behind, x, y)};
    store_plane(range + MACULA_PLANE_LEAST * pixels, &s, depths.least);
    store_plane(range + MACULA_PLANE_MOST * pixels, &s, depths.most);
    const Real facing = plane_at(normals, &s, 0, 0);
    store_plane(range + MACULA_PLANE_FACING * pixels, &s, thin ? splat(0.0f) : facing);
    const Before before = find_before(frame, &s, n.motion_x, n.motion_y, depths, past_range);
    const Mask judged = before.same & moves(n.motion_x, n.motion_y);
    const Mask same =
        before.same & (!judged | still_faces(normals, &s, before.facing, judged));
    store_followed(&s, n.motion_x, n.motion_y, same, followed);
}
