#include "host/metric/foveated.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace macula::metric {
namespace {

/// A map of what `of` says at the centre of each pixel.
template <class Of>
ScalarMap map_of(const scene::Display& display, const Of& of) {
    ScalarMap map(display.width, display.height);
    tbb::parallel_for(std::uint32_t{0}, display.height, [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < display.width; ++x)
            map.values[std::size_t{y} * display.width + x] =
                static_cast<float>(of(x + 0.5, y + 0.5));
    });
    return map;
}

} // namespace

ScalarMap eccentricity_map(const scene::Display& display, scene::Eye eye, const glm::dvec3& gaze) {
    return map_of(display,
                  [&](double x, double y) { return eccentricity(display, eye, x, y, gaze); });
}

ScalarMap density_map(const scene::Display& display, scene::Eye eye) {
    return map_of(display,
                  [&](double x, double y) { return pixels_per_degree(display, eye, x, y); });
}

scene::Display flat_display(std::uint32_t width, std::uint32_t height, double pixels_per_degree) {
    // At the centre a pixel is as many degrees wide as radians on the plane at distance 1.
    const double pixel = std::numbers::pi / 180.0 / pixels_per_degree;
    scene::EyeView view;
    view.tan_left = view.tan_right = 0.5 * width * pixel;
    view.tan_up = view.tan_down = 0.5 * height * pixel;
    scene::Display display;
    display.name = "flat";
    display.source = fmt::format("{} pixels per degree at its centre", pixels_per_degree);
    display.width = width;
    display.height = height;
    display.eyes = {view, view, view};
    return display;
}

std::vector<Band> default_bands() {
    return {{"fovea", 0.0, 2.6},
            {"parafovea", 2.6, 4.2},
            {"perifovea", 4.2, 9.2},
            {"far", 9.2, 180.1}}; // 180 included
}

std::vector<BandScore> band_scores(const ScalarMap& errors, const ScalarMap& eccentricity,
                                   std::span<const Band> bands) {
    if (errors.width != eccentricity.width || errors.height != eccentricity.height ||
        errors.values.size() != eccentricity.values.size())
        throw std::invalid_argument(
            fmt::format("errors of {} x {} pixels with eccentricities of {} x {}", errors.width,
                        errors.height, eccentricity.width, eccentricity.height));
    std::vector<BandScore> scores;
    std::vector<float> inside;
    for (const Band& band : bands) {
        inside.clear();
        for (std::size_t i = 0; i < errors.values.size(); ++i) {
            if (band.contains(eccentricity.values[i]))
                inside.push_back(errors.values[i]);
        }
        scores.push_back({band, inside.size(), inside.empty() ? Pooled{} : pool(inside)});
    }
    return scores;
}

} // namespace macula::metric
