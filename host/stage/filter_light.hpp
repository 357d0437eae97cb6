// The post-processor (Weier et al. 2016, section 3.5).
#pragma once

#include "host/stage/foveated.hpp"

namespace macula::stage {

// `light` (float or float4 a slot) -> "filtered light": resampled pixels outside of the fovea take
// the last frame's light of a reconstructed neighbour. `buffer`: the light buffer in which it lies.
frame::Stage filter_light(const FoveatedKit& kit, const std::string& light,
                          const std::string& buffer, std::uint32_t light_bytes);

} // namespace macula::stage
