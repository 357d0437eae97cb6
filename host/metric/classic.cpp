#include "host/metric/classic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

#include "host/metric/separable.hpp"

namespace macula::metric {
namespace {

float encoded(float linear) {
    const float x = std::clamp(linear, 0.0f, 1.0f);
    return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
}

/// The sum of `of_row` over all rows, which are summed in their order.
template <class OfRow>
double sum_of_rows(std::uint32_t height, const OfRow& of_row) {
    std::vector<double> sums(height);
    tbb::parallel_for(std::uint32_t{0}, height, [&](std::uint32_t y) { sums[y] = of_row(y); });
    double total = 0.0;
    for (const double x : sums)
        total += x;
    return total;
}

Plane luma(const Picture& picture) {
    Plane plane(picture.width, picture.height);
    tbb::parallel_for(std::uint32_t{0}, picture.height, [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < picture.width; ++x) {
            const float* rgb = &picture.rgb[3 * (std::size_t{y} * picture.width + x)];
            plane.row(y)[x] =
                0.299f * encoded(rgb[0]) + 0.587f * encoded(rgb[1]) + 0.114f * encoded(rgb[2]);
        }
    });
    return plane;
}

Plane product(const Plane& a, const Plane& b) {
    Plane result(a.width, a.height);
    std::transform(a.values.begin(), a.values.end(), b.values.begin(), result.values.begin(),
                   [](float x, float y) { return x * y; });
    return result;
}

Taps ssim_window(std::uint32_t side) {
    const int radius = static_cast<int>((std::min<std::uint32_t>(side, 11) - 1) / 2);
    std::vector<double> values;
    double sum = 0.0;
    for (int i = -radius; i <= radius; ++i) {
        values.push_back(std::exp(-i * i / (2.0 * 1.5 * 1.5)));
        sum += values.back();
    }
    Taps taps;
    for (const double x : values)
        taps.weights.push_back(static_cast<float>(x / sum));
    return taps;
}

double similarity(double mean_a, double mean_b, double square_a, double square_b, double both) {
    constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
    const double variance_a = square_a - mean_a * mean_a, variance_b = square_b - mean_b * mean_b;
    const double covariance = both - mean_a * mean_b;
    return (2.0 * mean_a * mean_b + c1) * (2.0 * covariance + c2) /
           ((mean_a * mean_a + mean_b * mean_b + c1) * (variance_a + variance_b + c2));
}

} // namespace

double mse(const Picture& reference, const Picture& test) {
    check_pair(reference, test);
    const std::size_t stride = 3 * std::size_t{reference.width};
    const double total = sum_of_rows(reference.height, [&](std::uint32_t y) {
        double sum = 0.0;
        for (std::size_t i = y * stride; i < (y + 1) * stride; ++i) {
            const double d = double{encoded(reference.rgb[i])} - double{encoded(test.rgb[i])};
            sum += d * d;
        }
        return sum;
    });
    return total / static_cast<double>(reference.rgb.size());
}

double psnr(double mean_squared_error) {
    return mean_squared_error > 0.0 ? -10.0 * std::log10(mean_squared_error)
                                    : std::numeric_limits<double>::infinity();
}

double ssim(const Picture& reference, const Picture& test) {
    check_pair(reference, test);
    const Plane a = luma(reference), b = luma(test);
    const Taps taps = ssim_window(std::min(a.width, a.height));
    const auto radius = static_cast<std::uint32_t>(taps.radius());
    const Window inside{radius, radius, a.width - radius, a.height - radius};
    const Plane* planes[2] = {&a, &b};
    const Plane products[3] = {product(a, a), product(b, b), product(a, b)};
    FilteredRows rows[5];
    for (int i = 0; i < 5; ++i)
        rows[i] = filter_rows(i < 2 ? *planes[i] : products[i - 2], inside, taps, taps.radius());
    const double total = sum_of_rows(inside.height(), [&](std::uint32_t y) {
        std::vector<float> values[5];
        for (int i = 0; i < 5; ++i) {
            values[i].resize(inside.width());
            filter_column_row(rows[i], inside.y0 + y, a.height, taps, values[i]);
        }
        double sum = 0.0;
        for (std::size_t x = 0; x < inside.width(); ++x)
            sum += similarity(values[0][x], values[1][x], values[2][x], values[3][x], values[4][x]);
        return sum;
    });
    return total / (static_cast<double>(inside.width()) * inside.height());
}

} // namespace macula::metric
