/* Surfaces followed from frame to frame, for methods that sample each pixel. */
#include "upscale/follow.h"

/* One work-item a strip. followed: as store_followed() writes it. range: two planes, what the next
 * frame compares with: the pixel's own depth, or the nearest around it, which moves an edge. */
kernel void follow_surfaces(global const FrameParams* restrict frame,
                            global const float* restrict surfaces,
                            global const float* restrict past_range, global float* restrict range,
                            global float* restrict followed) {
    const Strip s = strip_of_item(frame->width, frame->height);
    if (s.y >= s.height)
        return;
    const uint pixels = frame->width * frame->height;
    const Nearest n = nearest_surface(surfaces, pixels, &s);
    store_plane(range, &s, n.depth);
    const Real own = plane_at(surfaces + MACULA_PLANE_DEPTH * pixels, &s, 0, 0);
    const Real x = plane_at(surfaces + MACULA_PLANE_MOTION_X * pixels, &s, 0, 0);
    const Real y = plane_at(surfaces + MACULA_PLANE_MOTION_Y * pixels, &s, 0, 0);
    store_plane(range + pixels, &s, seam_depth(&n, own, x, y));
    const Depths depths = {n.depth, n.depth};
    store_followed(frame, &s, n.motion_x, n.motion_y, depths, past_range, followed);
}
