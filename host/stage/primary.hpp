// Primary rays and their hits.
#pragma once

#include "host/stage/kit.hpp"

namespace macula::stage {

// Writes "primary rays" (RayBlocks), "pixel of slot" and "ray count": all pixels.
frame::Stage primary_rays(const Kit& kit);

// "primary rays" -> "hits". `ray_class`: primary for full images, sparse for lists with gaps.
frame::Stage trace_primary_rays(const Kit& kit,
                                kernel::RayClass ray_class = kernel::RayClass::primary);

} // namespace macula::stage
