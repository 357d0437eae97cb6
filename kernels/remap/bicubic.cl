/* Enlarges an image by Catmull and Rom's cubic. */
#include "lib/camera.h"
#include "lib/cubic.h"

/* One work-item a slot of the large image. */
kernel void enlarge_bicubic(global const FrameParams* restrict frame, uint width, uint height,
                            global const float4* restrict samples, global float4* restrict colour) {
    const uint slot = (uint)get_global_id(0);
    uint x, y;
    pixel_of_slot(slot, frame->width, &x, &y);
    if (x >= frame->width || y >= frame->height)
        return;
    const float sx = fma((float)x + 0.5f, m_divide((float)width, (float)frame->width), -0.5f);
    const float sy = fma((float)y + 0.5f, m_divide((float)height, (float)frame->height), -0.5f);
    const int i = (int)rint(floor(sx)), j = (int)rint(floor(sy));
    const float4 found = cubic_at(samples, width, height, i, j, sx - (float)i, sy - (float)j);
    colour[y * frame->width + x] = (float4)(found.xyz, 1.0f);
}
