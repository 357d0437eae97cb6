// The end of a frame for a head-mounted display: the image is warped for its lens.
#pragma once

#include <array>

#include "host/frame/frame_params.hpp"
#include "host/stage/kit.hpp"
#include "scenes/display.hpp"
#include "shared/lens.h"

namespace macula::stage {

// Red, green, blue.
using LensDistortion = std::array<scene::Distortion, 3>;

// A panel whose edges, where they are nearest to the view axis, show through the lens in green what
// lies at the edges of the rendered view. Throws std::invalid_argument for more coefficients than
// MACULA_LENS_TERMS, and for a polynomial that turns back before it reaches an edge.
shared::LensParams make_lens(const LensDistortion& distortion, const frame::Tangents& view,
                             std::uint32_t width, std::uint32_t height);

// `picture`, a resource of the picture's size -> "lens image".
frame::Stage prewarp(const Kit& kit, const shared::LensParams& lens, const std::string& picture);

} // namespace macula::stage
