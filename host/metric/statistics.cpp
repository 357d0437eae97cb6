#include "host/metric/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace macula::metric {

double percentile(std::span<const double> values, double p) {
    if (values.empty())
        throw std::invalid_argument("percentile of no values");
    if (!(p >= 0.0 && p <= 1.0))
        throw std::invalid_argument("percentile outside 0..1");
    if (std::any_of(values.begin(), values.end(), [](double x) { return std::isnan(x); }))
        throw std::invalid_argument("percentile of values with a NaN");
    std::vector<double> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    const double position = p * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(position);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    const double fraction = position - static_cast<double>(below);
    // Equal neighbours are returned as they are, so that infinities do not become NaN.
    if (sorted[below] == sorted[above] || fraction == 0.0)
        return sorted[below];
    return sorted[below] + (sorted[above] - sorted[below]) * fraction;
}

double median(std::span<const double> values) {
    return percentile(values, 0.5);
}

double geometric_mean(std::span<const double> values) {
    if (values.empty())
        throw std::invalid_argument("geometric mean of no values");
    double sum = 0.0;
    for (const double value : values) {
        if (!(value > 0.0 && std::isfinite(value)))
            throw std::invalid_argument("geometric mean of a value that is not positive");
        sum += std::log(value);
    }
    return std::exp(sum / static_cast<double>(values.size()));
}

std::vector<double> ratios(std::span<const double> a, std::span<const double> b) {
    if (a.size() != b.size())
        throw std::invalid_argument("ratios of series of different lengths");
    std::vector<double> result(a.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        result[i] = a[i] / b[i];
    return result;
}

std::vector<std::vector<double>> interleave(std::span<const Measurement> measurements,
                                            std::size_t rounds) {
    std::vector<std::vector<double>> results(measurements.size(), std::vector<double>(rounds));
    for (std::size_t round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < measurements.size(); ++i) {
            const std::size_t m = round % 2 == 0 ? i : measurements.size() - 1 - i;
            results[m][round] = measurements[m]();
        }
    }
    return results;
}

} // namespace macula::metric
