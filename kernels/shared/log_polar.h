/* Kernel log-polar foveation (Mrad 2022, sections 2.2.2 and 4.2, after Meng et al. 2018). */
#ifndef MACULA_SHARED_LOG_POLAR_H
#define MACULA_SHARED_LOG_POLAR_H

#include "shared/language.h"

MACULA_SHARED_BEGIN

/* Constant while a method lives. */
typedef struct LogPolarParams {
    uint width, height;         /* texels of the buffer: columns along the radius, rows around it */
    float alpha, inverse_alpha; /* of the kernel function K(x) = x^alpha */
    float disk;         /* radius of the foveal disk: part of the image's half diagonal ... */
    float disk_tangent; /* ... or, above 0, the tangent of its angle */
    float fade;      /* part of the disk's radius within which it passes into what surrounds it */
    uint capacity;   /* slots of the list of samples */
    uint pitch;      /* of a row of the buffer: an empty texel, the columns, an empty texel */
    uint thesis_lod; /* 1: textures are filtered for a pixel and a bias (equation 4.2), else for a
                      * sample's texel */
    float spread_scale; /* of samples beyond the disk: undoes FrameSettings.sharpening */
    uint pad;
} LogPolarParams;
MACULA_ASSERT_SIZE(LogPolarParams, 48);

/* Where the gaze meets the image; made on the device for each frame. */
typedef struct Fovea {
    float x, y;    /* pixels; may lie outside of the image */
    float log_far; /* log2(1 + distance to the furthest corner of the image in pixels) */
    float inverse_log_far;
    float radius;      /* of the foveal disk, pixels */
    float inner;       /* from here to `radius` the disk passes into what surrounds it */
    uint first_column; /* of the buffer that is needed; columns before it lie within the disk. Of a
                        * log-rectilinear buffer: 0, or its width where nothing of it is needed */
    uint pad;
} Fovea;
MACULA_ASSERT_SIZE(Fovea, 32);

MACULA_SHARED_END
#endif
