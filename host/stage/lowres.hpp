// A coarser grid of samples over the whole view, and its enlargement.
#pragma once

#include "host/stage/kit.hpp"

namespace macula::stage {

// Samples along each axis.
struct Coarse {
    std::uint32_t width, height;
};

// `scale`: part of the pixels along each axis, above 0 and at most 1. Throws std::invalid_argument.
Coarse coarse_size(const Kit& kit, float scale);

// "primary rays", "pixel of slot" (the index of the coarse sample) and "ray count".
frame::Stage grid_rays(const Kit& kit, Coarse size);

// "sampled colour" -> "colour", by a bicubic filter.
frame::Stage enlarge(const Kit& kit, Coarse size);

} // namespace macula::stage
