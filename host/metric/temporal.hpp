/// What a still picture does not show: how a sequence changes from frame to frame where its
/// reference does not.
#pragma once

#include <span>
#include <vector>

#include "host/metric/foveated.hpp"

namespace macula::metric {

/// Where a pixel's surface lay in the last frame minus where it lies in this one, in pixels, two
/// floats (right, down) a pixel: the AOV `motion` (Motion.X, Motion.Y). A pixel whose source lies
/// outside the picture is left out of the scores.
struct MotionField {
    std::uint32_t width = 0, height = 0;
    std::vector<float> xy;
};

/// Lightness (CIE L* / 100, 0..1) changes; 0 is perfect in both.
struct TemporalScore {
    Band band;
    std::size_t pixels = 0; // that were compared, over all frames
    /// Mean of |T(t) - warped T(t-1)| - |R(t) - warped R(t-1)|: what the test changes from frame to
    /// frame, motion compensated, beyond what the reference changes. Negative when it changes less,
    /// as a blurred picture does.
    double instability = 0.0;
    /// Half the mean square of the frame-to-frame change of T - R, motion compensated: at a still
    /// camera the variance over time of a flicker without memory.
    double flicker_energy = 0.0;
};

/// Fed with frames in their order; compares each with the one before.
class TemporalScores {
  public:
    /// `bands` of eccentricity around each frame's gaze.
    explicit TemporalScores(std::vector<Band> bands = default_bands());

    /// `motion`: null for a still camera. The first frame gives no scores (no pixels). Returns the
    /// scores of this frame alone, band by band. Throws std::invalid_argument when a picture does
    /// not suit (check_pair) or has another size than the frame before.
    std::vector<TemporalScore> add(const Picture& reference, const Picture& test,
                                   const ScalarMap& eccentricity,
                                   const MotionField* motion = nullptr);

    /// Over all frames so far, band by band, and as the last entry over all pixels ("all").
    std::vector<TemporalScore> total() const;
    std::size_t frames() const { return frames_; }

  private:
    struct Sum {
        std::size_t pixels = 0;
        double instability = 0.0, energy = 0.0;
        void add(const Sum& other) {
            pixels += other.pixels;
            instability += other.instability;
            energy += other.energy;
        }
    };
    /// From the frame before, of which `reference` and `test` are the lightness now.
    std::vector<Sum> changes(const ScalarMap& reference, const ScalarMap& test,
                             const ScalarMap& eccentricity, const MotionField* motion) const;
    std::vector<TemporalScore> scores_of(std::span<const Sum> sums) const;

    std::vector<Band> bands_;
    std::vector<Sum> sums_; // one more than bands: all pixels
    ScalarMap reference_, test_;
    std::size_t frames_ = 0;
};

} // namespace macula::metric
