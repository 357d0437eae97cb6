/// Errors as colours.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "host/metric/picture.hpp"

namespace macula::metric {

/// sRGB of matplotlib's magma (van der Walt and Smith 2015, public domain) at 0..1, clamped.
std::array<std::uint8_t, 3> magma(float value);

/// Three bytes a pixel, rows from the top.
std::vector<std::uint8_t> heat_map(const ScalarMap& errors);

/// The same as a picture, for those who write pictures of linear light.
Picture heat_picture(const ScalarMap& errors);

} // namespace macula::metric
