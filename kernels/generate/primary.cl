/* Primary rays of all pixels, in the order of lib/camera.h. */
#include "lib/camera_ray.h"

/* One work-item a slot of generate_camera_ray. */
kernel void generate_primary_rays(global const FrameParams* restrict frame, uint sample,
                                  global RayBlock* restrict rays, global uint* restrict pixels,
                                  global uint* restrict ray_count,
                                  global ulong* restrict ray_totals, uint ray_class) {
    generate_camera_ray(frame, frame->width, frame->height, sample, (uint)get_global_id(0), rays,
                        pixels, ray_count, ray_totals + ray_class);
}
