/* Parameters of foveated ray tracing with a reprojection cache (Weier et al. 2016). Constant while
 * a method lives; names and sections are the paper's. */
#ifndef MACULA_SHARED_WEIER_H
#define MACULA_SHARED_WEIER_H

#include "shared/language.h"

MACULA_SHARED_BEGIN

/* Why a mesh cell's pixels are sampled anew (section 3.3): bits of the resampling info. */
#define MACULA_RESAMPLE_DEPTH 1u     /* depth leaves the neighbour's plane: a silhouette */
#define MACULA_RESAMPLE_LUMINANCE 2u /* a contrast that the eye notices */
#define MACULA_RESAMPLE_GRAZING 4u   /* seen edge-on in the last frame */
#define MACULA_RESAMPLE_STRETCHED 8u /* more pixels now than samples then */
#define MACULA_RESAMPLE_NEW 16u      /* of a pixel: the last frame did not see it */
#define MACULA_RESAMPLE_CHANGED 32u  /* something moved here, or changed what is seen here */
/* Of a cell: some part of it lies in the new view. */
#define MACULA_CELL_IN_VIEW 256u

/* What a support sample shows that its history does not; else the frames for which a change that
 * was found there, or where its history lay, is still remembered, times MACULA_CHANGE_FRAME. */
#define MACULA_CHANGE_OF_LIGHT 1u
#define MACULA_CHANGE_OF_SURFACE 2u
#define MACULA_CHANGE_NOW 3u /* either of them */
#define MACULA_CHANGE_FRAME 4u

/* A pixel that the mesh does not cover. */
#define MACULA_NO_KEY 0xffffffffu
/* Of the tables from pixel to support sample. */
#define MACULA_NO_CELL 0xffffffffu

typedef struct WeierParams {
    float r0, r1; /* degrees of eccentricity, r0 <= r1 (section 3.1) */
    float p_min;  /* sampling probability beyond r1 */
    uint jitter;  /* 1: rays go through a hashed point of the pixel, 0: its middle */
    uint support_width, support_height;
    uint pitch; /* pixels a row of the buffer of keys; a multiple of 32 */
    uint cell_bits_x, cell_bits_y;
    uint depth_bits;           /* of a key; with the cell's bits and the flag 32 in all */
    float depth_threshold;     /* eps_depth: part of the depth */
    float luminance_threshold; /* eps_lum: difference of luminances, each clamped to [0, 1] */
    float edge_threshold;      /* of edge_t, a cosine */
    float stretch_threshold;   /* ratio of lengths */
    uint resample_new;         /* 1: what enters the view is sampled rather than filled */
    float merge_threshold;     /* eps of section 3.4: part of the depth */
    uint filter_samples;       /* in a footprint of several texels (section 3.2) */
    float log2_k_min, log2_k_slope, k_max; /* k_t = min(2^(min + slope (dt - 1)), k_max) */
    uint filter_window;                    /* pixels: how far section 3.5 looks */
    uint filter_tries;                     /* n of section 3.5 */
    uint first_frame_full;                 /* 1: without history every pixel is sampled */
    float resampled_worth;                 /* part of rho that reading between texels leaves */
} WeierParams;
MACULA_ASSERT_SIZE(WeierParams, 96);

/* An instance, in the order of their triangles' ids. */
typedef struct InstanceMotion {
    uint first_triangle; /* scene-wide id of its triangle 0 */
    uint motion;         /* 0: it stands still; else its number among those that moved, from 1 on */
} InstanceMotion;
MACULA_ASSERT_SIZE(InstanceMotion, 8);

MACULA_SHARED_END
#endif
