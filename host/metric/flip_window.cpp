#include "host/metric/flip_window.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "host/metric/flip.hpp"
#include "host/metric/flip_colour.hpp"
#include "host/metric/flip_filters.hpp"

namespace macula::metric {
namespace {

// Andersson et al. 2020, sections 4.1.3 and 4.3.
constexpr float kColourExponent = 0.7f, kFeatureExponent = 0.5f;
constexpr float kKnee = 0.4f, kKneeError = 0.95f;

/// A picture filtered along its rows, by all filters.
struct Rows {
    FilteredRows achromatic, red_green, blue_yellow[2], smooth, edge, point;

    Rows(const Opponent& picture, const FlipFilters& f, const Window& window)
        : achromatic(filter_rows(picture.y, window, f.achromatic, f.reach())),
          red_green(filter_rows(picture.cx, window, f.red_green, f.reach())),
          blue_yellow{filter_rows(picture.cz, window, f.blue_yellow_rows[0], f.reach()),
                      filter_rows(picture.cz, window, f.blue_yellow_rows[1], f.reach())},
          smooth(filter_rows(picture.lightness, window, f.smooth, f.reach())),
          edge(filter_rows(picture.lightness, window, f.edge, f.reach())),
          point(filter_rows(picture.lightness, window, f.point, f.reach())) {}
};

/// One row of a picture, filtered both ways.
struct Row {
    std::vector<float> y, cx, cz, cz_rest, edge_x, edge_y, point_x, point_y;

    explicit Row(std::size_t width)
        : y(width), cx(width), cz(width), cz_rest(width), edge_x(width), edge_y(width),
          point_x(width), point_y(width) {}

    void fill(const Rows& rows, const FlipFilters& f, std::uint32_t at, std::uint32_t height) {
        filter_column_row(rows.achromatic, at, height, f.achromatic, y);
        filter_column_row(rows.red_green, at, height, f.red_green, cx);
        filter_column_row(rows.blue_yellow[0], at, height, f.blue_yellow_columns[0], cz);
        filter_column_row(rows.blue_yellow[1], at, height, f.blue_yellow_columns[1], cz_rest);
        filter_column_row(rows.edge, at, height, f.smooth, edge_x);
        filter_column_row(rows.smooth, at, height, f.edge, edge_y);
        filter_column_row(rows.point, at, height, f.smooth, point_x);
        filter_column_row(rows.smooth, at, height, f.point, point_y);
    }
    Colour lab(std::size_t x) const {
        return hunt_lab_of_rgb(clamped(rgb_of_ycxcz({y[x], cx[x], cz[x] + cz_rest[x]})));
    }
    static float length(float a, float b) { return std::sqrt(a * a + b * b); }
    float edge(std::size_t x) const { return length(edge_x[x], edge_y[x]); }
    float point(std::size_t x) const { return length(point_x[x], point_y[x]); }
};

/// The greatest distance that two colours of a display can have: green and blue.
float greatest_distance() {
    static const float value =
        std::pow(hyab(hunt_lab_of_rgb({0.0f, 1.0f, 0.0f}), hunt_lab_of_rgb({0.0f, 0.0f, 1.0f})),
                 kColourExponent);
    return value;
}

/// Most of the range is given to small distances.
float colour_error(const Colour& reference, const Colour& test) {
    const float most = greatest_distance(), knee = kKnee * most;
    const float distance = std::pow(hyab(reference, test), kColourExponent);
    return distance < knee ? distance * (kKneeError / knee)
                           : kKneeError + (distance - knee) / (most - knee) * (1.0f - kKneeError);
}

float error(const Row& reference, const Row& test, std::size_t x) {
    const float colour = colour_error(reference.lab(x), test.lab(x));
    const float difference = std::max(std::fabs(reference.edge(x) - test.edge(x)),
                                      std::fabs(reference.point(x) - test.point(x)));
    const float feature = std::pow(difference / std::sqrt(2.0f), kFeatureExponent);
    return std::clamp(std::pow(colour, 1.0f - feature), 0.0f, 1.0f);
}

} // namespace

Opponent::Opponent(const Picture& picture)
    : y(picture.width, picture.height), cx(picture.width, picture.height),
      cz(picture.width, picture.height), lightness(picture.width, picture.height) {
    tbb::parallel_for(std::uint32_t{0}, picture.height, [&](std::uint32_t row) {
        const std::size_t first = std::size_t{row} * picture.width;
        for (std::size_t i = first; i < first + picture.width; ++i) {
            const float* rgb = &picture.rgb[3 * i];
            const Colour c = ycxcz_of_rgb(clamped({rgb[0], rgb[1], rgb[2]}));
            y.values[i] = c.x;
            cx.values[i] = c.y;
            cz.values[i] = c.z;
            lightness.values[i] = (c.x + 16.0f) / 116.0f;
        }
    });
}

Opponent::Opponent(Plane y_plane, Plane cx_plane, Plane cz_plane, Plane lightness_plane)
    : y(std::move(y_plane)), cx(std::move(cx_plane)), cz(std::move(cz_plane)),
      lightness(std::move(lightness_plane)) {}

void check_density(double pixels_per_degree) {
    if (!(pixels_per_degree >= kMinPixelsPerDegree && pixels_per_degree <= kMaxPixelsPerDegree))
        throw std::invalid_argument(fmt::format("{} pixels per degree: {} to {} were expected",
                                                pixels_per_degree, kMinPixelsPerDegree,
                                                kMaxPixelsPerDegree));
}

Plane flip_window(const Opponent& reference, const Opponent& test, double pixels_per_degree,
                  const Window& window) {
    const FlipFilters filters(pixels_per_degree);
    const Rows reference_rows(reference, filters, window), test_rows(test, filters, window);
    Plane errors(window.width(), window.height());
    tbb::parallel_for(std::uint32_t{0}, window.height(), [&](std::uint32_t row) {
        Row r(window.width()), t(window.width());
        r.fill(reference_rows, filters, window.y0 + row, reference.y.height);
        t.fill(test_rows, filters, window.y0 + row, reference.y.height);
        float* out = errors.row(row);
        for (std::size_t x = 0; x < window.width(); ++x)
            out[x] = error(r, t, x);
    });
    return errors;
}

} // namespace macula::metric
