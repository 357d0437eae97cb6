/// The filters of FLIP for one density of pixels (Andersson et al. 2020, sections 4.1 and 4.2).
#pragma once

#include "host/metric/separable.hpp"

namespace macula::metric {

struct FlipFilters {
    explicit FlipFilters(double pixels_per_degree);

    /// Contrast sensitivity, achromatic, red-green, and blue-yellow as the sum of two Gaussians;
    /// `_columns` carries the weight of the sum.
    Taps achromatic, red_green, blue_yellow_rows[2], blue_yellow_columns[2];
    /// Gaussian and its first and second derivative, positive and negative weights of 1 in all.
    Taps smooth, edge, point;

    /// The largest radius of all.
    int reach() const;
};

} // namespace macula::metric
