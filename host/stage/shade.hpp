// From surfaces and light to colours, and from slots to pixels.
#pragma once

#include "host/stage/kit.hpp"

namespace macula::stage {

// G-buffer and light buffer -> "surface colour" (float4 a slot: linear RGB radiance, 1).
// `direct_light`, `ambient_occlusion`: which parts of the light buffer the method has; `irradiance`
// and `openness` name them.
frame::Stage shade(const Kit& kit, bool direct_light, bool ambient_occlusion,
                   const std::string& irradiance = "surface irradiance",
                   const std::string& openness = "surface openness");

// The mean over the pixel's samples: float or float4 a slot -> the same a pixel.
frame::Stage average_samples(const Kit& kit, const std::string& from, const std::string& image);
frame::Stage average_scalar_samples(const Kit& kit, const std::string& from,
                                    const std::string& image);

// The mean over the samples of each slot of a list: `element_bytes` of floats.
frame::Stage average_listed(const Kit& kit, const std::string& from, const std::string& mean,
                            std::uint32_t element_bytes);

// The first sample of each pixel, as it is: for what has no meaningful mean.
frame::Stage keep_first_sample(const Kit& kit, const std::string& from, const std::string& image,
                               std::uint32_t element_bytes);

} // namespace macula::stage
