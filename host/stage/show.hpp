// Intermediate results of foveated ray tracing as images, and the overlay.
#pragma once

#include "host/stage/foveated.hpp"

namespace macula::stage {

// Per pixel, each only if somebody reads it: "sampling" (uint: 0 not sampled, 1 blended with the
// cache, 2 taken as it is), "resampling" (uint: MACULA_RESAMPLE_*), "cache age" (uint: frames since
// the last sample, 2^20 - 1: none yet), "rho" (float), "support colour" (float4: the nearest
// support sample).
frame::Stage show_intermediates(const FoveatedKit& kit);

// kit.image -> "colour": the sampled pixels tinted, circles at r0 and r1.
frame::Stage draw_overlay(const FoveatedKit& kit);

} // namespace macula::stage
