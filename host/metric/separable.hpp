/// Separable filters on planes of floats; beyond its edges a plane goes on with its edge's values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace macula::metric {

/// Weights at -radius .. radius.
struct Taps {
    std::vector<float> weights;
    int radius() const { return static_cast<int>(weights.size() / 2); }
};

/// A rectangle of pixels, ends excluded.
struct Window {
    std::uint32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    std::uint32_t width() const { return x1 - x0; }
    std::uint32_t height() const { return y1 - y0; }
};

struct Plane {
    std::uint32_t width = 0, height = 0;
    std::vector<float> values;

    Plane() = default;
    Plane(std::uint32_t w, std::uint32_t h) : width(w), height(h), values(std::size_t{w} * h) {}
    float* row(std::uint32_t y) { return values.data() + std::size_t{y} * width; }
    const float* row(std::uint32_t y) const { return values.data() + std::size_t{y} * width; }
};

/// A plane filtered along its rows, within some of its columns and rows.
struct FilteredRows {
    Plane plane;
    std::uint32_t first_row = 0; // of the picture, in plane.row(0)
};

/// Along rows, for the columns of `window` and the rows that a filter of radius `reach` needs above
/// and below it. The sum of a pixel goes from left to right.
FilteredRows filter_rows(const Plane& in, const Window& window, const Taps& taps, int reach);

/// Row `y` of the picture of height `height`, filtered along columns, from top to bottom.
void filter_column_row(const FilteredRows& in, std::uint32_t y, std::uint32_t height,
                       const Taps& taps, std::span<float> out);

} // namespace macula::metric
