/* Where this frame's samples hit things thinner than what is rendered. */
#include "lib/camera.h"
#include "shared/surface.h"
#include "upscale/fovea.h"
#include "upscale/locks.h"
#include "upscale/neighbours.h"
#include "upscale/ridge.h"

/* Luma of one sample is unlike another's, as a part of their sum. */
#define UNLIKE 0.2f
/* A lock lasts for as many frames without its thing as so many samples a pixel take. */
#define LIFE_SAMPLES 8.0f
/* Pixels that a thing and what lies around it may part by before its lock ends. */
#define MOST_TRAIL 1.5f

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

/* How far a sample and what lies around it part in a frame, in pixels of the picture. Its
 * neighbours have the motion of what is in front among them. */
static inline Real parting_of(global const float* followed, uint pixels, const Strip* s,
                              float ratio_x, float ratio_y) {
    const Real x = plane_at(followed, s, 0, 0), y = plane_at(followed + pixels, s, 0, 0);
    const Real none = splat(MACULA_NO_MOTION), zero = splat(0.0f);
    Real most = zero;
    for (uint k = 0u; k < 9u; ++k) {
        const int i = 2 * (int)(k % 3u) - 2, j = 2 * (int)(k / 3u) - 2;
        const Real other_x = plane_at(followed, s, i, j);
        const Real apart = m_max(fabs(other_x - x) * splat(ratio_x),
                                 fabs(plane_at(followed + pixels, s, i, j) - y) * splat(ratio_y));
        most = other_x < none ? m_max(most, apart) : most;
    }
    /* What was not there in the last frame goes its own way, for all that is known. */
    return x < none ? most : none;
}

/* Frames; `samples`: pixels of the picture for a sample; `parting`: in pixels of the picture. What
 * goes its own way fast has none. */
MACULA_ALWAYS_INLINE Real lock_life(float samples, Real parting) {
    const float life = m_min(rint(samples * LIFE_SAMPLES), MOST_LIFE);
    const float rate = m_divide(life, MOST_TRAIL);
    const Real frames = floor(m_divide(splat(life), m_max(parting * splat(rate), splat(1.0f))));
    return frames >= splat(2.0f) ? frames : splat(0.0f);
}

/* One work-item a strip of what is rendered. thin: the frames that the lock of a thin thing lasts,
 * 0 where there is none, and the mean luma of what lies beside it. `fovea`: null, or the disk
 * beyond which nothing is gathered. */
kernel void find_thin(uint width, uint height, uint target_width, uint target_height,
                      global const Fovea* restrict fovea, global const float* restrict planes,
                      global const float* restrict followed, global float* restrict thin) {
    const Strip s = strip_of_item(width, height);
    if (s.y >= s.height)
        return;
    if (fovea && !any_lane(distance_to_gaze(fovea, &s) < splat(fovea->radius + 5.0f)))
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
    if (!any_lane(ridge)) {
        store_plane(thin, &s, splat(0.0f));
        return;
    }
    const float ratio_x = m_divide((float)target_width, (float)width);
    const float ratio_y = m_divide((float)target_height, (float)height);
    const Real parting = parting_of(followed, width * height, &s, ratio_x, ratio_y);
    store_plane(thin, &s, ridge ? lock_life(ratio_x * ratio_y, parting) : splat(0.0f));
    store_plane(thin + width * height, &s, m_divide(sum, m_max(count, splat(1.0f))));
}
