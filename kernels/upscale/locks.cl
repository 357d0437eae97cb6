/* Where this frame's samples hit things thinner than what is rendered. */
#include "lib/camera.h"
#include "upscale/fovea.h"
#include "upscale/locks.h"
#include "upscale/neighbours.h"
#include "upscale/ridge.h"

/* Luma of one sample is unlike another's, as a part of their sum. */
#define UNLIKE 0.1f

static inline Nine lumas_of(global const float* planes, uint pixels, const Strip* s) {
    Nine n;
    for (uint k = 0u; k < 9u; ++k) {
        const int i = (int)(k % 3u) - 1, j = (int)(k / 3u) - 1;
        const Real3 c = make3(plane_at(planes, s, i, j), plane_at(planes + pixels, s, i, j),
                              plane_at(planes + 2u * pixels, s, i, j));
        n.v[k] = luma_of(c).x;
    }
    return n;
}

/* One work-item a strip of what is rendered. thin: the mean luma of what lies beside a thin thing,
 * NOT_THIN where there is none. `fovea`: null, or the disk beyond which nothing is gathered. */
kernel void find_thin(uint width, uint height, global const Fovea* restrict fovea,
                      global const float* restrict planes, global float* restrict thin) {
    const Strip s = strip_of_item(width, height);
    if (s.y >= s.height)
        return;
    if (fovea && !any_lane(distance_to_gaze(fovea, &s) < splat(fovea->radius + 4.0f)))
        return;
    const Nine lumas = lumas_of(planes, width * height, &s);
    const Beside beside = beside_middle(&lumas, UNLIKE);
    Mask unlike[9];
    Mask above = beside.above[4], below = beside.below[4];
    Real sum = splat(0.0f), count = splat(0.0f);
    for (uint k = 0u; k < 9u; ++k) {
        above = above | beside.above[k];
        below = below | beside.below[k];
        unlike[k] = beside.above[k] | beside.below[k];
        sum = sum + (unlike[k] ? lumas.v[k] : splat(0.0f));
        count = count + (unlike[k] ? splat(1.0f) : splat(0.0f));
    }
    /* Between brighter and darker ones it is a part of a slope. */
    const Mask ridge = no_block_alike(unlike) & !(above & below);
    store_plane(thin, &s, ridge ? m_divide(sum, m_max(count, splat(1.0f))) : splat(NOT_THIN));
}
