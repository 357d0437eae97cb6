#include "host/metric/separable.hpp"

#include <algorithm>

#include <tbb/parallel_for.h>

namespace macula::metric {
namespace {

std::int64_t clamped(std::int64_t i, std::uint32_t count) {
    return std::clamp<std::int64_t>(i, 0, std::int64_t{count} - 1);
}

void add_scaled(std::span<float> out, const float* in, float weight) {
    float* const sums = out.data();
    const std::size_t count = out.size();
    for (std::size_t x = 0; x < count; ++x)
        sums[x] += weight * in[x];
}

} // namespace

FilteredRows filter_rows(const Plane& in, const Window& window, const Taps& taps, int reach) {
    const auto first =
        static_cast<std::uint32_t>(clamped(std::int64_t{window.y0} - reach, in.height));
    const auto last =
        static_cast<std::uint32_t>(clamped(std::int64_t{window.y1} - 1 + reach, in.height));
    FilteredRows out{Plane(window.width(), last - first + 1), first};
    const int radius = taps.radius();
    tbb::parallel_for(std::uint32_t{0}, out.plane.height, [&](std::uint32_t y) {
        const float* source = in.row(first + y);
        std::vector<float> padded(window.width() + taps.weights.size() - 1);
        for (std::size_t i = 0; i < padded.size(); ++i)
            padded[i] =
                source[clamped(static_cast<std::int64_t>(window.x0 + i) - radius, in.width)];
        for (std::size_t k = 0; k < taps.weights.size(); ++k)
            add_scaled({out.plane.row(y), window.width()}, &padded[k], taps.weights[k]);
    });
    return out;
}

void filter_column_row(const FilteredRows& in, std::uint32_t y, std::uint32_t height,
                       const Taps& taps, std::span<float> out) {
    std::fill(out.begin(), out.end(), 0.0f);
    const std::int64_t first = std::int64_t{y} - taps.radius();
    for (std::size_t k = 0; k < taps.weights.size(); ++k) {
        const auto source =
            static_cast<std::uint32_t>(clamped(first + static_cast<std::int64_t>(k), height));
        add_scaled(out, in.plane.row(source - in.first_row), taps.weights[k]);
    }
}

} // namespace macula::metric
