// The G-buffer: what the primary rays hit.
#pragma once

#include "host/stage/kit.hpp"

namespace macula::stage {

// "hits" -> the G-buffer, one entry a slot, each part only if somebody reads it: "surface depth"
// (float, along the view axis), "surface position" (float4; w: distance to keep from the surface),
// "surface geometric normal", "surface shading normal" (float4, unit, towards the viewer),
// "surface albedo", "surface specular" (w: shininess), "surface emission" (float4),
// "surface triangle", "surface material" (uint), "surface motion" (float2, pixels: the position in
// the last frame minus that in this one). Of a miss: MACULA_BACKGROUND_DEPTH, zeros, the
// background's radiance as emission, MACULA_NO_TRIANGLE.
// `spreads`: the resource with the pixels across each slot's footprint; without it one pixel.
frame::Stage resolve_surface(const Kit& kit, const std::string& spreads = {});

} // namespace macula::stage
