/// FLIP in a part of a picture: what whole pictures and foveated ones are made of.
#pragma once

#include "host/metric/picture.hpp"
#include "host/metric/separable.hpp"

namespace macula::metric {

/// A picture in the opponent colours YCxCz.
struct Opponent {
    Plane y, cx, cz;
    Plane lightness; // (y + 16) / 116: 0..1, where edges and points are looked for

    /// Clamps to 0..1.
    explicit Opponent(const Picture& picture);
    Opponent(Plane y_plane, Plane cx_plane, Plane cz_plane, Plane lightness_plane);
};

/// Errors of the window's pixels; pixels beyond the window count for their neighbours' filters.
/// `pixels_per_degree` within kMinPixelsPerDegree..kMaxPixelsPerDegree.
Plane flip_window(const Opponent& reference, const Opponent& test, double pixels_per_degree,
                  const Window& window);

/// Throws std::invalid_argument when `pixels_per_degree` is out of range.
void check_density(double pixels_per_degree);

} // namespace macula::metric
