#include "host/metric/classic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <tbb/parallel_for.h>

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

/// One double a pixel: variances are differences of nearly equal sums.
struct Luma {
    std::size_t width, height;
    std::vector<double> values;

    explicit Luma(const Picture& picture)
        : width(picture.width), height(picture.height), values(picture.pixels()) {
        tbb::parallel_for(std::size_t{0}, height, [&](std::size_t y) {
            for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
                const float* rgb = &picture.rgb[3 * i];
                values[i] =
                    0.299 * encoded(rgb[0]) + 0.587 * encoded(rgb[1]) + 0.114 * encoded(rgb[2]);
            }
        });
    }
};

/// Weights of a Gaussian over the greatest odd number of pixels up to 11 that fits.
std::vector<double> ssim_window(std::size_t side) {
    const int radius = static_cast<int>((std::min<std::size_t>(side, 11) - 1) / 2);
    std::vector<double> weights;
    double sum = 0.0;
    for (int i = -radius; i <= radius; ++i) {
        weights.push_back(std::exp(-i * i / (2.0 * 1.5 * 1.5)));
        sum += weights.back();
    }
    for (double& weight : weights)
        weight /= sum;
    return weights;
}

/// Means of a, b, a^2, b^2 and a b around a pixel, or along a row of one.
struct Moments {
    double a = 0.0, b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;
    void add(const Moments& m, double weight) {
        a += weight * m.a;
        b += weight * m.b;
        aa += weight * m.aa;
        bb += weight * m.bb;
        ab += weight * m.ab;
    }
};

/// Along the rows, of the columns that the window fits around.
std::vector<Moments> row_moments(const Luma& a, const Luma& b, const std::vector<double>& weights) {
    const std::size_t width = a.width - weights.size() + 1;
    std::vector<Moments> result(width * a.height);
    tbb::parallel_for(std::size_t{0}, a.height, [&](std::size_t y) {
        for (std::size_t x = 0; x < width; ++x) {
            for (std::size_t k = 0; k < weights.size(); ++k) {
                const double va = a.values[y * a.width + x + k];
                const double vb = b.values[y * a.width + x + k];
                result[y * width + x].add({va, vb, va * va, vb * vb, va * vb}, weights[k]);
            }
        }
    });
    return result;
}

double similarity(const Moments& m) {
    constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
    const double variance_a = m.aa - m.a * m.a, variance_b = m.bb - m.b * m.b;
    const double covariance = m.ab - m.a * m.b;
    return (2.0 * m.a * m.b + c1) * (2.0 * covariance + c2) /
           ((m.a * m.a + m.b * m.b + c1) * (variance_a + variance_b + c2));
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
    const std::vector<double> weights = ssim_window(std::min(reference.width, reference.height));
    const std::vector<Moments> rows = row_moments(Luma(reference), Luma(test), weights);
    const std::size_t height = reference.height - weights.size() + 1;
    const std::size_t width = rows.size() / reference.height;
    const double total = sum_of_rows(static_cast<std::uint32_t>(height), [&](std::size_t y) {
        double sum = 0.0;
        for (std::size_t x = 0; x < width; ++x) {
            Moments m;
            for (std::size_t k = 0; k < weights.size(); ++k)
                m.add(rows[(y + k) * width + x], weights[k]);
            sum += similarity(m);
        }
        return sum;
    });
    return total / static_cast<double>(width * height);
}

} // namespace macula::metric
