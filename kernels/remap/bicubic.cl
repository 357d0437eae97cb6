/* Enlarges an image by Catmull and Rom's cubic, which keeps the samples themselves. */
#include "lib/camera.h"

/* Weights of four neighbours for a place t in [0, 1) after the second one. */
static inline float4 cubic_weights(float t) {
    const float s = 1.0f - t;
    return (float4)(-0.5f * t * s * s, fma(t * t, fma(1.5f, t, -2.5f), 1.0f),
                    fma(s * s, fma(1.5f, s, -2.5f), 1.0f), -0.5f * s * t * t);
}

static inline float4 cubic_row(global const float4* row, int x, int last, float4 w) {
    const float4 a = row[clamp(x - 1, 0, last)], b = row[clamp(x, 0, last)];
    const float4 c = row[clamp(x + 1, 0, last)], d = row[clamp(x + 2, 0, last)];
    return fma((float4)(w.x), a, fma((float4)(w.y), b, fma((float4)(w.z), c, w.w * d)));
}

/* One work-item a slot of the large image. The cubic's overshoot below 0 is cut off. */
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
    const float4 wx = cubic_weights(sx - (float)i), wy = cubic_weights(sy - (float)j);
    const int last = (int)width - 1, bottom = (int)height - 1;
    float4 rows[4];
    for (int k = 0; k < 4; ++k)
        rows[k] = cubic_row(samples + (uint)clamp(j + k - 1, 0, bottom) * width, i, last, wx);
    const float4 sum =
        fma((float4)(wy.x), rows[0],
            fma((float4)(wy.y), rows[1], fma((float4)(wy.z), rows[2], wy.w * rows[3])));
    const float4 kept = sum > 0.0f ? sum : (float4)(0.0f);
    colour[y * frame->width + x] = (float4)(kept.xyz, 1.0f);
}
