/* Primary rays through the middles of a coarser grid of pixels that covers the view. */
#include "lib/camera_ray.h"

/* One work-item a slot of generate_camera_ray for width x height samples. */
kernel void generate_grid_rays(global const FrameParams* restrict frame, uint width, uint height,
                               uint sample, global RayBlock* restrict rays,
                               global uint* restrict pixels, global uint* restrict ray_count,
                               global ulong* restrict ray_totals, uint ray_class) {
    generate_camera_ray(frame, width, height, sample, (uint)get_global_id(0), rays, pixels,
                        ray_count, ray_totals + ray_class);
}
