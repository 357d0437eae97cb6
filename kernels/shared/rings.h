/* Rectangular rings of pixel blocks around the gaze: the multi-resolution renderer that Smith et
 * al. 2014 began with (section 3.2.1, figure 8). Blocks are pixels in the foveal rectangle and 2, 4
 * and 8 pixels wide in the rings around it. */
#ifndef MACULA_SHARED_RINGS_H
#define MACULA_SHARED_RINGS_H

#include "shared/language.h"

MACULA_SHARED_BEGIN

#define MACULA_RING_EDGES 3
/* Width in pixels of the blocks beyond the last edge; all blocks lie on a grid of that width. */
#define MACULA_WIDEST_BLOCK 8

/* Constant while a method lives. */
typedef struct RingParams {
    float degrees[3]; /* from the gaze to the edges, along each axis; from 90 on everything */
    uint blur;        /* 1: blocks are blurred, 0: shown as they are */
    uint grid;        /* 1: the blocks' outlines are drawn */
    uint pad[3];
} RingParams;
MACULA_ASSERT_SIZE(RingParams, 32);

/* The rectangles within the edges, made on the device for each frame: pixels left <= x < right, top
 * <= y < bottom. Each is a whole number of the blocks around it. They may reach beyond the image or
 * lie outside of it. The last entry is not used. */
typedef struct Rings {
    int left[4], top[4], right[4], bottom[4];
} Rings;
MACULA_ASSERT_SIZE(Rings, 64);

MACULA_SHARED_END
#endif
