/* Points of [0, 1)^2 from spatio-temporal blue noise (Wolfe et al. 2022): the points of all pixels
 * are one low-discrepancy sequence, which each pixel turns by its own texel of the mask. So few
 * points of a pixel cover the square evenly, neighbours in the image and in time err in different
 * directions, and many points of one pixel converge. Integers alone: the same bits everywhere. */
#ifndef MACULA_LIB_BLUE_NOISE_H
#define MACULA_LIB_BLUE_NOISE_H

#include "lib/lanes.h"
#include "shared/blue_noise.h"

MACULA_SHARED_BEGIN

/* The texel of a place in a frame. `shift`: any bits; different ones give masks that do not repeat
 * one another. */
MACULA_ALWAYS_INLINE Uint noise_texel(Uint x, Uint y, uint frame, uint shift) {
    const uint slice = (frame + (shift >> 24)) % MACULA_NOISE_SLICES;
    const Uint column = (x + (shift & 0xffu)) % MACULA_NOISE_SIDE;
    const Uint row = (y + ((shift >> 8) & 0xffu)) % MACULA_NOISE_SIDE;
    return (slice * MACULA_NOISE_SIDE + row) * MACULA_NOISE_SIDE + column;
}

/* Point `index` of the sequence R2 (Roberts 2018), turned by a texel of the mask. */
MACULA_ALWAYS_INLINE void blue_point(Uint texel, Uint index, Real* u, Real* v) {
    const Uint along = (texel & 0xffff0000u) + index * 0xc13fa9a9u;
    const Uint across = (texel << 16) + index * 0x91e10da5u;
    *u = uint_to_real(along >> 8) * 0x1p-24f;
    *v = uint_to_real(across >> 8) * 0x1p-24f;
}

MACULA_SHARED_END
#endif
