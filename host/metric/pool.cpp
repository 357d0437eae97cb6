#include "host/metric/pool.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace macula::metric {
namespace {

/// Ascending, by three passes over 11 bits each: floats that are not negative sort as their bits
/// do.
std::vector<float> sorted_errors(std::span<const float> values) {
    if (values.empty())
        throw std::invalid_argument("pooling no errors");
    if (!std::all_of(values.begin(), values.end(), [](float x) { return x >= 0.0f; }))
        throw std::invalid_argument("pooling errors of which one is negative or not a number");
    std::vector<float> sorted(values.begin(), values.end()), other(values.size());
    for (float& x : sorted)
        x += 0.0f; // -0 becomes 0
    constexpr unsigned bits = 11, buckets = 1u << bits;
    for (unsigned shift = 0; shift < 32; shift += bits) {
        const auto bucket = [&](float x) {
            return std::bit_cast<std::uint32_t>(x) >> shift & (buckets - 1);
        };
        std::array<std::size_t, buckets + 1> first{};
        for (const float x : sorted)
            ++first[bucket(x) + 1];
        std::partial_sum(first.begin(), first.end(), first.begin());
        for (const float x : sorted)
            other[first[bucket(x)]++] = x;
        sorted.swap(other);
    }
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
