/* What a pixel's colour is worth that the remap of log-polar and log-rectilinear foveation has made
 * of samples beside it. OpenCL C only. */
#ifndef MACULA_UPSCALE_NEARNESS_H
#define MACULA_UPSCALE_NEARNESS_H

#include "lib/lanes.h"

#define LEAST_NEARNESS 0.01f
/* Beyond the disk, of the nearest sample while things move. There samples count by the root of how
 * near they are: where a history is short, unequal shares show as the teeth of a comb. At rest,
 * where many come, the nearest make a sharper mean. */
#define MOVING_NEARNESS 0.6f

/* In samples: a product, whose sum with something takes an fma. */
typedef struct Worth {
    Real scale, amount;
} Worth;

/* `nearness`: 0..1, 1 in the disk, where each pixel is sampled. */
MACULA_ALWAYS_INLINE Worth worth_of_nearness(Real nearness, Mask still) {
    const Real one = splat(1.0f), near = clamped(nearness, splat(LEAST_NEARNESS), one);
    const Mask by_square = still | (near >= one);
    const Worth worth = {by_square ? near : splat(MOVING_NEARNESS),
                         by_square ? near : m_sqrt(near)};
    return worth;
}

#endif
