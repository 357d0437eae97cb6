/// FLIP: the difference that one sees when two pictures alternate in place (Andersson et al.,
/// "FLIP: A Difference Evaluator for Alternating Images", HPG 2020), and HDR-FLIP for pictures
/// whose exposure is still open (Andersson et al., "Visualizing Errors in Rendered High Dynamic
/// Range Images", Eurographics 2021). Computed on the host by oneTBB; the result does not depend on
/// the number of threads.
#pragma once

#include <optional>

#include "host/metric/picture.hpp"

namespace macula::metric {

/// 0.7 m from a screen 0.7 m and 3840 pixels wide (Andersson et al. 2020, section 7).
inline constexpr double kDefaultPixelsPerDegree = 67.02;
/// Filters of the size of the picture at the most: beyond it no error can be told from its
/// neighbours.
inline constexpr double kMinPixelsPerDegree = 0.1, kMaxPixelsPerDegree = 2000.0;

/// Errors 0 (none) .. 1, a pixel each. Values outside 0..1 are clamped, as a display does.
/// Throws std::invalid_argument: check_pair, pixels per degree out of range.
ScalarMap flip(const Picture& reference, const Picture& test,
               double pixels_per_degree = kDefaultPixelsPerDegree);

/// Exposures that HDR-FLIP looks through, in stops (factors of two).
struct Exposures {
    double start = 0.0, stop = 0.0;
    unsigned count = 2; // >= 2 (1 when start == stop), start and stop included
};

enum class ToneMapper { aces, hable, reinhard };

/// From the exposure at which the brightest pixel of the reference reaches 85 % of the display's
/// white to the one at which its median does (Andersson et al. 2021, section 3).
Exposures find_exposures(const Picture& reference, ToneMapper tone_mapper = ToneMapper::aces);

/// The greatest LDR-FLIP error over all exposures. Negative light counts as none. `exposures`: of
/// find_exposures where none are given. Throws as flip does.
ScalarMap hdr_flip(const Picture& reference, const Picture& test,
                   double pixels_per_degree = kDefaultPixelsPerDegree,
                   const std::optional<Exposures>& exposures = {},
                   ToneMapper tone_mapper = ToneMapper::aces);

} // namespace macula::metric
