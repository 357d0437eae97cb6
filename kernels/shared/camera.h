/* One view of the scene: a pinhole camera with four independent FOV tangents, so that asymmetric
 * head-mounted displays need nothing else. World space is right-handed; x right, y up in the
 * image; rows run downwards from the top. */
#ifndef MACULA_SHARED_CAMERA_H
#define MACULA_SHARED_CAMERA_H

#include "shared/language.h"

MACULA_SHARED_BEGIN

/* right, up, forward: orthonormal world-space axes. Tangents are positive magnitudes from the
 * forward axis to the image's edges. The direction through the image point (x, y) in pixels is
 * right * sx + up * sy + forward with
 *   sx = fma(x, (tan_right + tan_left) / width, -tan_left),
 *   sy = fma(y, -(tan_up + tan_down) / height, tan_up),
 * so that t along it is the depth along `forward`. */
typedef struct Camera {
    float origin[3];
    float tan_left;
    float right[3];
    float tan_right;
    float up[3];
    float tan_up;
    float forward[3];
    float tan_down;
} Camera;
MACULA_ASSERT_SIZE(Camera, 64);

/* Constant over one frame of one view. */
typedef struct FrameParams {
    Camera camera;
    Camera previous_camera; /* last frame's; equal to camera in the first frame */
    float gaze[3];          /* unit direction of gaze in world space */
    float pixel_spread; /* width of a pixel's ray cone at depth 1 (Akenine-Moeller et al. 2019) */
    uint width, height; /* pixels of the view */
    uint frame;         /* frame index: a dimension of every random number */
    uint seed;
    uint samples_per_pixel;
    uint sample_grid; /* N when samples_per_pixel = N * N: a regular grid; 0: hashed offsets */
    uint light_count;
    uint ambient_occlusion_samples; /* 0: none */
    uint ambient_occlusion_columns; /* of the grid of strata; divides the number of samples */
    float ambient_occlusion_radius; /* world units */
    float gaze_widening;            /* factor on the foveal radii, >= 1: the gaze may be stale */
    float lod_bias;                 /* levels that every texture lookup goes up, or below 0 down */
    float ambient[3];               /* ambient radiance, linear RGB */
    uint pad_ambient;
    float background[3]; /* radiance of rays that miss, linear RGB */
    uint pad_background;
    /* Where in its pixel the samples of this frame lie, from its middle, in pixels; 0 for methods
     * that do not gather samples over frames. Motion does not know of it. */
    float jitter[2];
    uint pad_jitter[2];
} FrameParams;
MACULA_ASSERT_SIZE(FrameParams, 240);

MACULA_SHARED_END
#endif
