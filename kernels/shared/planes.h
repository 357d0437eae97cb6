/* The planes that temporal anti-aliasing and upscaling share: one float for each pixel, one plane
 * after another. */
#ifndef MACULA_SHARED_PLANES_H
#define MACULA_SHARED_PLANES_H


/* "surface planes": what each sampled pixel shows. */
#define MACULA_PLANE_DEPTH 0u    /* along the view axis; MACULA_BACKGROUND_DEPTH: nothing */
#define MACULA_PLANE_MOTION_X 1u /* pixels: last frame's place minus this one's */
#define MACULA_PLANE_MOTION_Y 2u
#define MACULA_PLANE_NORMAL 3u /* the geometric one as of pack_normal(); 0: not known */
#define MACULA_SURFACE_PLANES 4u

/* "depth range": what the next frame compares with. */
#define MACULA_PLANE_LEAST 0u
#define MACULA_PLANE_MOST 1u
#define MACULA_PLANE_FACING 2u /* a packed normal, 0: any, or the negative of normal_set() */
#define MACULA_RANGE_PLANES 3u

/* "stable planes", "upscaled planes": colours, and what they are worth in samples. */
#define MACULA_PLANE_WORTH 3u
#define MACULA_COLOUR_PLANES 4u

/* "colour planes" of a foveated method: three of colour, and how near a sample lies to a pixel, of
 * which it is made, 0..1. */
#define MACULA_PLANE_NEARNESS 3u

/* "upscaled planes" beside these: luma around and of thin features, where their worth says that
 * there are any. */
#define MACULA_PLANE_GROUND 4u
#define MACULA_PLANE_RIDGE 5u
#define MACULA_UPSCALED_PLANES 6u

/* What the upscaler does beyond the disk of a foveated method. */
#define MACULA_BEYOND_NOTHING 0u /* there is no disk */
#define MACULA_BEYOND_GATHER 1u  /* gather, without jitter */
#define MACULA_BEYOND_SMOOTH 2u  /* enlarge what is smooth already */

/* Rows of the picture that a work-item enlarges. */
#define MACULA_ENLARGED_ROWS 8u

#endif
