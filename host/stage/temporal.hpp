// What gathers samples over frames: surfaces are followed from frame to frame, colours smoothed
// (temporal anti-aliasing) and enlarged (temporal upscaling). docs/methods/upscale.md.
#pragma once

#include "host/stage/kit.hpp"
#include "host/stage/log_polar.hpp"

namespace macula::stage {

// Images of these stages are planes: one float for each pixel, one plane after another
// (kernels/upscale/planes.h).

// "surface planes": depth and motion of each pixel's first sample, for methods that sample all.
frame::Stage place_surfaces(const Kit& kit);
// "sampled surfaces", the same of the disk alone, and "log-polar surface" of the buffer's texels.
frame::Stage place_surfaces(const LogPolarKit& kit);
// "sampled surfaces" and "log-polar surface" -> "followed motion", as of follow_surfaces(), and
// "sample spread", the deviation of the luminance of the samples that a pixel is made of.
frame::Stage remap_surfaces(const LogPolarKit& kit);

struct TemporalKit {
    Kit kit;
    bool foveated;    // the method has a "fovea" and follows its surfaces itself
    bool antialiased; // `antialias` is among its stages, and `upscale`
    bool upscaled;
    float frame_rate;    // frames a second
    float sharpness;     // 0..1
    bool cached = false; // the method has "fresh pixels": others are means of many frames' samples
};

// "surface planes" -> "followed motion", none where the last frame saw another surface.
frame::Stage follow_surfaces(const TemporalKit& kit);
// "colour" -> "stable planes" and "stable colour".
frame::Stage antialias(const TemporalKit& kit);
// "colour" -> "colour planes", for `upscale` where nothing is smoothed.
frame::Stage split_colour(const TemporalKit& kit);
// "stable planes" or "colour planes" -> "upscaled planes" and "upscaled colour", of the picture's
// size.
frame::Stage upscale(const TemporalKit& kit);

} // namespace macula::stage
