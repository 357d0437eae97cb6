// Ambient occlusion.
#pragma once

#include "host/stage/kit.hpp"

namespace macula::stage {

// Writes the light buffer's "surface openness": float a slot, the cosine-weighted part of the
// hemisphere that is free within the radius (1: open).
frame::Stage ambient_occlusion(const Kit& kit);

} // namespace macula::stage
