// Scores of a method's frames against their references.
#pragma once

#include <optional>
#include <vector>

#include "bench/quality_reference.hpp"
#include "host/metric/foveated.hpp"
#include "host/report/quality_case.hpp"

namespace macula::bench {

class QualityScores {
  public:
    // `r0`: degrees of the region that is compared with `full` apart.
    QualityScores(const scene::Display& display, double pixels_per_degree, double r0);

    // Frames in the order of QualityFlight::spots(); `look`: the gaze in head space. Returns the
    // map of FLIP errors against the converged reference.
    metric::ScalarMap add(const QualityFlight::Spot& spot, const ReferenceFrame& reference,
                          const metric::Picture& test, const glm::dvec3& look);

    // Fills scores, against_full, bands, eccentricity and all series but `ms`.
    void fill(report::QualityCase& result) const;

  private:
    struct Mean {
        double sum = 0.0, count = 0.0;
        void add(double value, double weight = 1.0) {
            sum += value * weight;
            count += weight;
        }
        std::optional<double> value() const {
            return count > 0.0 ? std::optional(sum / count) : std::nullopt;
        }
    };

    void add_bands(const metric::ScalarMap& flip, const metric::ScalarMap& eccentricity);
    void add_temporal(const QualityFlight::Spot& spot, const ReferenceFrame& reference,
                      const metric::Picture& test, const metric::ScalarMap& eccentricity);

    const scene::Display& display_;
    double pixels_per_degree_, r0_;
    metric::ScalarMap density_;
    std::vector<metric::Band> bands_;
    std::vector<float> flip_, foveated_flip_; // of all pixels of all frames
    Mean mse_, ssim_, full_flip_, full_inside_;
    std::vector<Mean> curve_; // by steps of eccentricity
    std::vector<Mean> band_flip_, band_energy_, band_instability_;
    std::optional<metric::TemporalScores> temporal_; // of the stretch
    Mean energy_, instability_;
    report::Series series_;
};

} // namespace macula::bench
