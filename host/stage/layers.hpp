// Blended surfaces between the primary rays' origins and their hits (kernels/shade/layers.cl).
#pragma once

#include "host/stage/kit.hpp"

namespace macula::stage {

// The list of the nearest Kit::layers layers of each slot's ray, with the parts that secondary rays
// have ("layer rays", "layer ray count", "layer pixel of slot", "layer root", "layer throughput",
// "layer origin") and "layer hits"; and "light through layers" (float a slot of the primary rays).
// What lies behind the layers that are kept is merged into the last. `kit`: of the primary rays.
// `spreads`: as resolve_surface() takes it.
frame::Stage collect_layers(const Kit& kit, const std::string& spreads);
// What comes through the layers of `total`, and "layer surface colour" over it, in place: "colour
// behind layers".
frame::Stage add_layers(const Kit& kit, const std::string& total);

} // namespace macula::stage
