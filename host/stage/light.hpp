// Direct light through shadow rays.
#pragma once

#include "host/stage/kit.hpp"

namespace macula::stage {

// How many places lie in a row of the image and of a method's own buffer, whose texels are the
// places of "pixel of slot" beyond the image's pixels: blue noise is laid over both.
struct PlaceRows {
    std::uint32_t pixels = 0; // 0: the frame's width
    std::uint32_t texels = 0; // 0: there is no such buffer
};

// Writes the light buffer's "surface irradiance" (float4 a slot, apart from the albedo: Weier et
// al. 2016, section 3.1) and "surface highlight" (float4: what Phong's lobe reflects of a white
// highlight colour). Lights add up in their order.
frame::Stage direct_light(const Kit& kit, PlaceRows rows = {});

} // namespace macula::stage
