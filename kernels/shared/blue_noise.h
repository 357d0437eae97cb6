/* The size of the mask of spatio-temporal blue noise (host/frame/blue_noise.hpp). */
#ifndef MACULA_SHARED_BLUE_NOISE_H
#define MACULA_SHARED_BLUE_NOISE_H

#define MACULA_NOISE_SIDE 64u   /* texels of a slice along x and y; both wrap around */
#define MACULA_NOISE_SLICES 16u /* one for each frame; they wrap around, too */

/* A texel holds two numbers: its upper half is the one for u, its lower half the one for v. */

#endif
