// Which pixels are sampled, and their rays (Weier et al. 2016, section 3.1).
#pragma once

#include "host/stage/foveated.hpp"

namespace macula::stage {

// Foveal function, support grid and resampling info -> "sampling masks" (kernels/generate/
// foveated.cl: one word a packet), "list offsets" and "list length".
frame::Stage choose_pixels(const FoveatedKit& kit);

// Writes "primary rays", "pixel of slot" and "ray count": the chosen pixels in slot order. For
// within for_each_sample.
frame::Stage listed_rays(const FoveatedKit& kit);

} // namespace macula::stage
