// Direct light through shadow rays.
#pragma once

#include "host/stage/kit.hpp"

namespace macula::stage {

// Writes the light buffer's "surface irradiance" (float4 a slot, apart from the albedo: Weier et
// al. 2016, section 3.1) and "surface highlight" (float4: what Phong's lobe reflects of a white
// highlight colour). Lights add up in their order.
frame::Stage direct_light(const Kit& kit);

} // namespace macula::stage
