/* Primary rays of all pixels, in the order of lib/camera.h. */
#include "lib/camera_ray.h"
#include "shared/surface.h"

/* One work-item a slot; the launch covers slot_count(width, height), which is the ray count. */
kernel void generate_primary_rays(global const FrameParams* restrict frame, uint sample,
                                  global RayBlock* restrict rays, global uint* restrict pixels,
                                  global uint* restrict ray_count,
                                  global ulong* restrict ray_totals, uint ray_class) {
    const uint slot = get_global_id(0);
    const uint width = frame->width, height = frame->height;
    uint x, y;
    pixel_of_slot(slot, width, &x, &y);
    const bool inside = x < width && y < height;
    const uint pixel = y * width + x;
    float dx, dy;
    subpixel_offset(random_key(pixel, frame->frame, frame->seed), sample, frame->sample_grid, &dx,
                    &dy);
    const float3 direction =
        camera_direction(&frame->camera, width, height, (float)x + dx, (float)y + dy);
    store_camera_ray(frame, rays, slot, direction, inside ? MACULA_BACKGROUND_DEPTH : -1.0f);
    pixels[slot] = inside ? pixel : MACULA_NO_PIXEL;
    if (slot == 0u) {
        *ray_count = (uint)get_global_size(0);
        ray_totals[ray_class] += width * height;
    }
}
