/* Warps an image beforehand for the lens that it will be seen through. */
#include "lib/camera.h"
#include "lib/cubic.h"
#include "shared/lens.h"

/* k0 r^2 + k1 r^4 + ... of one colour. */
static inline float distortion_of(global const float* k, float r2) {
    float sum = k[MACULA_LENS_TERMS - 1u];
    for (uint n = MACULA_LENS_TERMS - 1u; n-- > 0u;)
        sum = fma(sum, r2, k[n]);
    return sum * r2;
}

/* What one colour of the pixel shows; 0 outside of the rendered image. Places are counted in 1/256
 * of a pixel, as texture units do, so that without distortion each pixel is itself. */
static inline float4 seen_through(global const float4* image, uint width, uint height,
                                  global const LensParams* lens, uint colour, float x, float y) {
    const float sx = fma(x, lens->step_x, -lens->left), sy = fma(y, -lens->step_y, lens->up);
    const float r2 = fma(sx, sx, sy * sy);
    const float g = distortion_of(lens->k + colour * MACULA_LENS_TERMS, r2);
    const float px = fma(lens->per_x * sx, g, fma(x, lens->scale_x, lens->shift_x));
    const float py = fma(-lens->per_y * sy, g, fma(y, lens->scale_y, lens->shift_y));
    if (!(r2 < lens->most[colour] && px >= 0.0f && py >= 0.0f && px <= (float)width &&
          py <= (float)height))
        return (float4)(0.0f);
    const int ix = (int)rint(fma(px, 256.0f, -128.0f)), iy = (int)rint(fma(py, 256.0f, -128.0f));
    return cubic_at(image, width, height, ix >> 8, iy >> 8, (float)(ix & 255) * 0x1p-8f,
                    (float)(iy & 255) * 0x1p-8f);
}

/* One work-item a slot of the picture. */
kernel void prewarp(uint width, uint height, global const LensParams* restrict lens,
                    global const float4* restrict colour, global float4* restrict warped) {
    const uint slot = (uint)get_global_id(0);
    uint column, row;
    pixel_of_slot(slot, width, &column, &row);
    if (column >= width || row >= height)
        return;
    const float x = (float)column + 0.5f, y = (float)row + 0.5f;
    const float4 red = seen_through(colour, width, height, lens, 0u, x, y);
    const float4 green = seen_through(colour, width, height, lens, 1u, x, y);
    const float4 blue = seen_through(colour, width, height, lens, 2u, x, y);
    warped[row * width + column] = (float4)(red.x, green.y, blue.z, 1.0f);
}
