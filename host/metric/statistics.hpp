// Order statistics of measurements, and the interleaving that makes them comparable.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace macula::metric {

// The value below which a fraction `p` of the values lies, linearly interpolated between order
// statistics (p = 0: least, 0.5: median, 1: greatest). Throws std::invalid_argument when `values`
// is empty, holds a NaN, or p lies outside 0..1.
double percentile(std::span<const double> values, double p);

// percentile(values, 0.5).
double median(std::span<const double> values);

// exp of the mean of the logarithms. Throws std::invalid_argument when `values` is empty or holds
// one that is not finite and positive.
double geometric_mean(std::span<const double> values);

// Medians of ratios are taken round by round, a[i] / b[i]: what slows a machine for a while slows
// both, and cancels. Throws std::invalid_argument when the lengths differ.
std::vector<double> ratios(std::span<const double> a, std::span<const double> b);

// A measurement: returns what one run took, in seconds.
using Measurement = std::function<double()>;

// Runs every measurement once a round, one after another, `rounds` times: result[m][round]. Rounds
// alternate between forward and backward order, so that no measurement always follows the same one.
std::vector<std::vector<double>> interleave(std::span<const Measurement> measurements,
                                            std::size_t rounds);

} // namespace macula::metric
