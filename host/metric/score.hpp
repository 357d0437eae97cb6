/// All scores of one frame at once.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "host/metric/flip.hpp"
#include "host/metric/foveated.hpp"
#include "host/metric/pool.hpp"

namespace macula::metric {

/// Where the eye looks in a frame, and what it sees there.
struct View {
    ScalarMap eccentricity; // degrees
    ScalarMap density;      // pixels per degree
};

struct ScoreOptions {
    double pixels_per_degree = kDefaultPixelsPerDegree;
    bool hdr = false; // HDR-FLIP in the place of FLIP; foveated FLIP is always that of a display
    std::optional<Exposures> exposures;
    ToneMapper tone_mapper = ToneMapper::aces;
    std::vector<Band> bands = default_bands(); // looked at where there is a view
};

struct FrameScores {
    ScalarMap flip_map, foveated_map; // the latter is empty without a view
    Pooled flip, foveated;
    std::vector<BandScore> bands, foveated_bands; // in the options' order; empty without a view
    double mse = 0.0, psnr = 0.0, ssim = 1.0;
    std::optional<Exposures> exposures; // of HDR-FLIP
};

/// Throws as the scores do.
FrameScores score(const Picture& reference, const Picture& test, const ScoreOptions& options,
                  const View* view = nullptr);

/// Of a sequence, without maps and exposures: means over the frames, of bands over the frames that
/// have pixels of them; but the least and greatest error of all, and the PSNR of the mean MSE.
/// Throws std::invalid_argument when there are no frames or their bands differ in number.
FrameScores average(std::span<const FrameScores> frames);

} // namespace macula::metric
