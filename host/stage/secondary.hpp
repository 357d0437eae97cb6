// Whitted's reflected and refracted rays (kernels/shade/secondary.cl), level by level: the kits
// here are those of the level that is made, Kit::at_level(1) and up.
#pragma once

#include "host/stage/kit.hpp"

namespace macula::stage {

// Level `kit.level`'s rays from the surfaces of the level before it: "bounce N rays", "ray count",
// "pixel of slot", "root" (uint: the slot of the primary ray), "throughput" (float4: weight in the
// pixel sample; w: width of the ray's cone at its origin), "origin" (float4; w: what the cone grows
// by in a unit of length). As many as twice the slots of
// the picture; of more, the weakest are left out.
// `spreads`: as resolve_surface() of the primary rays takes it.
frame::Stage secondary_rays(const Kit& kit, const std::string& spreads);
// "bounce N rays" -> "bounce N hits".
frame::Stage trace_secondary_rays(const Kit& kit);
// Adds "bounce N surface colour", times the throughput, to `total` (float4 a slot of the primary
// rays), in place: "colour after bounce N".
frame::Stage add_secondary_light(const Kit& kit, const std::string& total);

} // namespace macula::stage
