#include "bench/quality_scores.hpp"

#include <numeric>

#include "host/metric/classic.hpp"
#include "host/metric/flip.hpp"
#include "host/metric/pool.hpp"

namespace macula::bench {
namespace {

constexpr double kStep = 2.0; // degrees of eccentricity, of the curve

// Without the sorting of metric::pool().
double mean_of(const metric::ScalarMap& map) {
    return std::accumulate(map.values.begin(), map.values.end(), 0.0) /
           static_cast<double>(map.values.size());
}

report::Errors errors_of(const std::vector<float>& values) {
    const metric::Pooled pooled = metric::pool(values);
    return {pooled.mean, pooled.weighted_median, pooled.weighted_q1, pooled.weighted_q3,
            pooled.max};
}

void append(std::vector<float>& values, const metric::ScalarMap& map) {
    values.insert(values.end(), map.values.begin(), map.values.end());
}

} // namespace

QualityScores::QualityScores(const scene::Display& display, double pixels_per_degree, double r0)
    : display_(display), pixels_per_degree_(pixels_per_degree), r0_(r0),
      density_(metric::density_map(display, scene::Eye::mono)), bands_(metric::default_bands()),
      curve_(static_cast<std::size_t>(180.0 / kStep) + 1), band_flip_(bands_.size()),
      band_energy_(bands_.size()), band_instability_(bands_.size()) {}

metric::ScalarMap QualityScores::add(const QualityFlight::Spot& spot,
                                     const ReferenceFrame& reference, const metric::Picture& test,
                                     const glm::dvec3& look) {
    const auto eccentricity = metric::eccentricity_map(display_, scene::Eye::mono, look);
    metric::ScalarMap flip = metric::flip(reference.converged, test, pixels_per_degree_);
    const auto foveated = metric::foveated_flip(reference.converged, test, eccentricity, density_);
    append(flip_, flip);
    append(foveated_flip_, foveated);
    series_.frame.push_back(spot.frame);
    series_.flip.push_back(mean_of(flip));
    series_.foveated_flip.push_back(mean_of(foveated));
    mse_.add(metric::mse(reference.converged, test));
    ssim_.add(metric::ssim(reference.converged, test));
    add_bands(flip, eccentricity);

    const metric::ScalarMap beside_full =
        test.rgb == reference.full.rgb // as those of `full` itself are
            ? metric::ScalarMap(test.width, test.height)
            : metric::flip(reference.full, test, pixels_per_degree_);
    full_flip_.add(mean_of(beside_full));
    for (std::size_t i = 0; i < beside_full.values.size(); ++i) {
        if (eccentricity.values[i] < r0_)
            full_inside_.add(beside_full.values[i]);
    }
    add_temporal(spot, reference, test, eccentricity);
    return flip;
}

void QualityScores::add_bands(const metric::ScalarMap& flip,
                              const metric::ScalarMap& eccentricity) {
    for (std::size_t i = 0; i < flip.values.size(); ++i) {
        const double e = eccentricity.values[i];
        curve_[static_cast<std::size_t>(e / kStep)].add(flip.values[i]);
        for (std::size_t b = 0; b < bands_.size(); ++b) {
            if (e >= bands_[b].from && e < bands_[b].to)
                band_flip_[b].add(flip.values[i]);
        }
    }
}

void QualityScores::add_temporal(const QualityFlight::Spot& spot, const ReferenceFrame& reference,
                                 const metric::Picture& test,
                                 const metric::ScalarMap& eccentricity) {
    if (spot.first)
        temporal_.emplace(bands_);
    const auto scores = temporal_->add(reference.converged, test, eccentricity, &reference.motion);
    auto& energy = series_.flicker_energy.emplace_back();
    auto& instability = series_.instability.emplace_back();
    if (spot.first)
        return;
    for (std::size_t b = 0; b < bands_.size(); ++b) {
        const auto pixels = static_cast<double>(scores[b].pixels);
        band_energy_[b].add(scores[b].flicker_energy, pixels);
        band_instability_[b].add(scores[b].instability, pixels);
    }
    const metric::TemporalScore& all = scores.back(); // behind the bands
    if (all.pixels == 0)
        return; // nothing of the last frame is still in view
    energy = all.flicker_energy;
    instability = all.instability;
    energy_.add(all.flicker_energy, static_cast<double>(all.pixels));
    instability_.add(all.instability, static_cast<double>(all.pixels));
}

void QualityScores::fill(report::QualityCase& result) const {
    report::Scores& scores = result.scores;
    scores.flip = errors_of(flip_);
    scores.foveated_flip = errors_of(foveated_flip_);
    const double mse = mse_.value().value_or(0.0);
    if (mse > 0.0)
        scores.psnr = metric::psnr(mse);
    scores.ssim = ssim_.value().value_or(0.0);
    scores.flicker_energy = energy_.value();
    scores.instability = instability_.value();
    result.against_full = {full_flip_.value().value_or(0.0), r0_, full_inside_.value()};
    for (std::size_t b = 0; b < bands_.size(); ++b)
        result.bands.push_back({bands_[b].name, bands_[b].from, bands_[b].to,
                                band_flip_[b].count / static_cast<double>(flip_.size()),
                                band_flip_[b].value(), band_energy_[b].value(),
                                band_instability_[b].value()});
    for (std::size_t i = 0; i < curve_.size(); ++i) {
        if (const auto value = curve_[i].value()) {
            result.eccentricity.degrees.push_back(kStep * (static_cast<double>(i) + 0.5));
            result.eccentricity.flip.push_back(*value);
        }
    }
    result.series = series_;
}

} // namespace macula::bench
