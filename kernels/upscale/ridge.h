/* Things thinner than what is rendered: a sample that hits one, and none beside it does. OpenCL C
 * only. */
#ifndef MACULA_UPSCALE_RIDGE_H
#define MACULA_UPSCALE_RIDGE_H

#include "lib/strip.h"

/* Of three by three values, in rows. */
typedef struct Nine {
    Real v[9];
} Nine;

/* What of three by three values lies well above or below the middle one. */
typedef struct Beside {
    Mask above[9], below[9];
} Beside;

/* `part`: of the sum of two values, by which they differ at least. */
MACULA_ALWAYS_INLINE Beside beside_middle(const Nine* n, float part) {
    Beside b;
    for (uint k = 0u; k < 9u; ++k) {
        const Real limit = fma(n->v[k] + n->v[4], splat(part), splat(1e-4f));
        const Real apart = n->v[k] - n->v[4];
        b.above[k] = apart > limit;
        b.below[k] = apart < -limit;
    }
    return b;
}

/* No block of two by two around the middle is all alike: it is no part of anything wide. */
MACULA_ALWAYS_INLINE Mask no_block_alike(const Mask* unlike) {
    return (unlike[0] | unlike[1] | unlike[3]) & (unlike[1] | unlike[2] | unlike[5]) &
           (unlike[3] | unlike[6] | unlike[7]) & (unlike[5] | unlike[7] | unlike[8]);
}

#endif
