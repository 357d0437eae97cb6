/* Refresh rate modulation (Smith, Booth and Bailey 2014, section 3.2.1): which pixels a frame
 * refreshes. A plan is made for each frame from the gaze; its list of packets of 4 x 4 ray slots
 * follows from it in closed form. */
#ifndef MACULA_SHARED_RRM_H
#define MACULA_SHARED_RRM_H

#include "shared/language.h"

MACULA_SHARED_BEGIN

/* The fovea, and up to four rectangles around it for each of up to six rings. */
#define MACULA_REFRESH_REGIONS 25
/* Packets of a region lie in strips so many packets high, column by column. */
#define MACULA_REFRESH_STRIP 4u
/* The order of a group's blocks repeats after so many groups along each axis. */
#define MACULA_REFRESH_ORDERS 16u

/* The search for busy groups takes steps of so many of them: a prime, larger than their number, so
 * that a bounded number of them lies all over the picture. */
#define MACULA_REFRESH_STRIDE 2654435761u

/* A rectangle of packets. In the fovea a packet is 4 x 4 pixels, its origin (column, row) in
 * pixels. In the periphery a packet is one block of each of four neighbouring groups, a column or
 * row of packets is as wide or high as those groups, and each is listed group_blocks / period times
 * in a row, once for each block that is due. */
typedef struct RefreshRegion {
    uint first; /* of its packets in the list */
    uint column, row;
    uint columns, rows;
    uint period; /* frames from one refresh of a block to the next; 0: the fovea */
} RefreshRegion;
MACULA_ASSERT_SIZE(RefreshRegion, 24);

typedef struct RefreshPlan {
    uint x0, y0, x1, y1; /* the fovea's pixels, [x0, x1) x [y0, y1), on the grid of blocks */
    uint group_width, group_height; /* blocks */
    uint group_blocks;              /* N: their product */
    uint turn;                      /* of the groups: frames since the first, modulo N */
    uint frame;                     /* frames since the first */
    uint regions, packets;          /* without those of busy groups */
    uint foveal_packets;            /* the first of them: the whole fovea's */
    uint samples, foveal_samples;   /* of a pixel; at least as many in the fovea */
    uint foveal_grid;               /* FrameParams.sample_grid for foveal_samples */
    uint disk;                      /* 1: of the rectangle only blocks in the disk are foveal */
    float cosine;                   /* of the disk's eccentricity */
    uint corner_period;             /* of the rectangle's blocks beyond the disk */
    /* Groups that share a packet are busy together: where pixels change or move. */
    uint quads_across, quads; /* packets' groups that the picture has */
    uint first_quad;          /* with which the search for busy ones begins */
    uint busy_quads;          /* at most so many get further packets in a frame */
    uint busy_packets;        /* so many each; 0: nobody looks for them */
    uint hold;                /* frames that they stay busy */
    float change;             /* of a colour, from which on they are; 0: whatever it is */
    float motion_squared;     /* pixels a frame, squared; likewise */
    RefreshRegion region[MACULA_REFRESH_REGIONS];
} RefreshPlan;
MACULA_ASSERT_SIZE(RefreshPlan, 704);

MACULA_SHARED_END
#endif
