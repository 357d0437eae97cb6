#include "host/metric/flip_filters.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace macula::metric {
namespace {

using std::numbers::pi;

/// a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees (table 1 of the paper).
struct Gaussian {
    double a, b;
    double height() const { return a * std::sqrt(pi / b); }
};
constexpr Gaussian kAchromatic{1.0, 0.0047}, kRedGreen{1.0, 0.0053};
constexpr Gaussian kBlueYellow[2] = {{34.1, 0.04}, {13.5, 0.025}};
constexpr double kWidest = 0.04;        // of all b: one radius for all filters
constexpr double kFeatureWidth = 0.082; // degrees

std::vector<double> bell(double b, int radius, double pixels_per_degree) {
    std::vector<double> values;
    for (int i = -radius; i <= radius; ++i) {
        const double x = i / pixels_per_degree;
        values.push_back(std::exp(-pi * pi * x * x / b));
    }
    return values;
}

double sum(const std::vector<double>& values) {
    double total = 0.0;
    for (const double x : values)
        total += x;
    return total;
}

Taps scaled(const std::vector<double>& values, double factor) {
    Taps taps;
    for (const double x : values)
        taps.weights.push_back(static_cast<float>(x * factor));
    return taps;
}

Taps normalised(const std::vector<double>& values) {
    return scaled(values, 1.0 / sum(values));
}

/// Positive and negative weights sum to 1 and -1.
Taps balanced(std::vector<double> values) {
    double positive = 0.0, negative = 0.0;
    for (const double x : values)
        (x > 0.0 ? positive : negative) += std::fabs(x);
    for (double& x : values)
        x /= x > 0.0 ? positive : std::max(negative, 1e-300);
    return scaled(values, 1.0);
}

} // namespace

FlipFilters::FlipFilters(double pixels_per_degree) {
    const int radius =
        static_cast<int>(std::ceil(3.0 * std::sqrt(kWidest / (2.0 * pi * pi)) * pixels_per_degree));
    achromatic = normalised(bell(kAchromatic.b, radius, pixels_per_degree));
    red_green = normalised(bell(kRedGreen.b, radius, pixels_per_degree));
    double total = 0.0;
    for (const Gaussian& part : kBlueYellow) {
        const double s = sum(bell(part.b, radius, pixels_per_degree));
        total += part.height() * s * s;
    }
    for (int i = 0; i < 2; ++i) {
        const std::vector<double> values = bell(kBlueYellow[i].b, radius, pixels_per_degree);
        blue_yellow_rows[i] = scaled(values, 1.0);
        blue_yellow_columns[i] = scaled(values, kBlueYellow[i].height() / total);
    }
    const double sigma = 0.5 * kFeatureWidth * pixels_per_degree;
    const int feature_radius = static_cast<int>(std::ceil(3.0 * sigma));
    std::vector<double> g, first, second;
    for (int i = -feature_radius; i <= feature_radius; ++i) {
        const double x = i, value = std::exp(-x * x / (2.0 * sigma * sigma));
        g.push_back(value);
        first.push_back(-x * value);
        second.push_back((x * x / (sigma * sigma) - 1.0) * value);
    }
    smooth = normalised(g);
    edge = balanced(first);
    point = balanced(second);
}

int FlipFilters::reach() const {
    return std::max(achromatic.radius(), smooth.radius());
}

} // namespace macula::metric
