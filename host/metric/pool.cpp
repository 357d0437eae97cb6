#include "host/metric/pool.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace macula::metric {
namespace {

std::vector<float> sorted_errors(std::span<const float> values) {
    if (values.empty())
        throw std::invalid_argument("pooling no errors");
    if (!std::all_of(values.begin(), values.end(), [](float x) { return x >= 0.0f; }))
        throw std::invalid_argument("pooling errors of which one is negative or not a number");
    std::vector<float> sorted(values.begin(), values.end());
    std::sort(sorted.begin(), sorted.end());
    return sorted;
}

double sum(std::span<const float> sorted) {
    double total = 0.0;
    for (const float x : sorted)
        total += x;
    return total;
}

double quantile(std::span<const float> sorted, double total, double fraction) {
    double running = 0.0;
    for (const float x : sorted) {
        running += x;
        if (running > fraction * total)
            return x;
    }
    return sorted.back(); // fraction 1, or all 0
}

} // namespace

double weighted_quantile(std::span<const float> values, double fraction) {
    const std::vector<float> sorted = sorted_errors(values);
    return quantile(sorted, sum(sorted), fraction);
}

Pooled pool(std::span<const float> values) {
    // Sums in the order of size: the same for all threads, and exact to the last digits.
    const std::vector<float> sorted = sorted_errors(values);
    const double total = sum(sorted);
    return {total / static_cast<double>(sorted.size()),
            quantile(sorted, total, 0.5),
            quantile(sorted, total, 0.25),
            quantile(sorted, total, 0.75),
            sorted.front(),
            sorted.back()};
}

} // namespace macula::metric
