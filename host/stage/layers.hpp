// Blended surfaces between the origins of rays and their hits (kernels/shade/layers.cl), of primary
// and of secondary rays: the kits here are those of the rays.
#pragma once

#include "host/stage/kit.hpp"

namespace macula::stage {

// The list of the nearest Kit::layers layers of each slot's ray, with the parts that secondary rays
// have ("layer rays", "layer ray count", "layer pixel of slot", "layer root", "layer throughput",
// "layer origin") and "layer hits"; and "light through layers" (float a slot of the rays). What
// lies behind the layers that are kept is merged into the last. `spreads`: as resolve_surface()
// takes it.
frame::Stage collect_layers(const Kit& kit, const std::string& spreads);
// Adds "layer surface colour" to `total` in place, the colours of the primary rays' slots: "colour
// with layers". Of primary rays, after what comes through their layers has been taken of it.
frame::Stage add_layers(const Kit& kit, const std::string& total);

} // namespace macula::stage
