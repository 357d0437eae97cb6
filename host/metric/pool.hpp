/// A map of errors as a few numbers.
#pragma once

#include <span>

namespace macula::metric {

/// Andersson et al. 2020 (section 6): in weighted quantiles an error counts as often as it is
/// large, so that a few bad pixels in a good picture show.
struct Pooled {
    double mean = 0.0;
    double weighted_median = 0.0, weighted_q1 = 0.0, weighted_q3 = 0.0;
    double min = 0.0, max = 0.0;
};

/// The sorted errors' value at which the running sum first exceeds `fraction` (0..1) of the total;
/// 0 where all are 0. Throws std::invalid_argument when `values` is empty or one is negative or
/// NaN.
double weighted_quantile(std::span<const float> values, double fraction);

/// Throws as weighted_quantile does.
Pooled pool(std::span<const float> values);

} // namespace macula::metric
