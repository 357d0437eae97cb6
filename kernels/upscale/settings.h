/* What the upscaler does beyond the disk of a foveated method. */
#ifndef MACULA_UPSCALE_SETTINGS_H
#define MACULA_UPSCALE_SETTINGS_H

#define MACULA_BEYOND_NOTHING 0u /* there is no disk */
#define MACULA_BEYOND_GATHER 1u  /* gather, without jitter */
#define MACULA_BEYOND_SMOOTH 2u  /* enlarge what is smooth already */

#endif
