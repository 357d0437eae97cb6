#include "host/metric/score.hpp"

#include <algorithm>
#include <stdexcept>

#include "host/metric/classic.hpp"

namespace macula::metric {
namespace {

/// Sums up pooled errors of frames; `take` gives their mean.
class PooledMean {
  public:
    void add(const Pooled& p) {
        mean_.min = count_ == 0 ? p.min : std::min(mean_.min, p.min);
        mean_.max = std::max(mean_.max, p.max);
        mean_.mean += p.mean;
        mean_.weighted_median += p.weighted_median;
        mean_.weighted_q1 += p.weighted_q1;
        mean_.weighted_q3 += p.weighted_q3;
        ++count_;
    }
    Pooled take() const {
        Pooled p = mean_;
        for (double* value : {&p.mean, &p.weighted_median, &p.weighted_q1, &p.weighted_q3})
            *value /= static_cast<double>(std::max<std::size_t>(count_, 1));
        return p;
    }

  private:
    Pooled mean_;
    std::size_t count_ = 0;
};

/// One of the lists of bands of all frames.
std::vector<BandScore> average_bands(std::span<const FrameScores> frames,
                                     std::vector<BandScore> FrameScores::*list) {
    std::vector<BandScore> result;
    for (std::size_t b = 0; b < (frames.front().*list).size(); ++b) {
        BandScore score{(frames.front().*list)[b].band, 0, {}};
        PooledMean mean;
        for (const FrameScores& frame : frames) {
            if ((frame.*list).size() != (frames.front().*list).size())
                throw std::invalid_argument("averaging frames with different bands");
            const BandScore& own = (frame.*list)[b];
            score.pixels += own.pixels;
            if (own.pixels > 0)
                mean.add(own.errors);
        }
        score.errors = mean.take();
        result.push_back(score);
    }
    return result;
}

} // namespace

FrameScores score(const Picture& reference, const Picture& test, const ScoreOptions& options,
                  const View* view) {
    check_pair(reference, test);
    FrameScores scores;
    if (options.hdr) {
        scores.exposures =
            options.exposures ? *options.exposures : find_exposures(reference, options.tone_mapper);
        scores.flip_map = hdr_flip(reference, test, options.pixels_per_degree, scores.exposures,
                                   options.tone_mapper);
    } else {
        scores.flip_map = flip(reference, test, options.pixels_per_degree);
    }
    scores.flip = pool(scores.flip_map.values);
    if (view != nullptr) {
        scores.foveated_map = foveated_flip(reference, test, view->eccentricity, view->density);
        scores.foveated = pool(scores.foveated_map.values);
        scores.bands = band_scores(scores.flip_map, view->eccentricity, options.bands);
        scores.foveated_bands = band_scores(scores.foveated_map, view->eccentricity, options.bands);
    }
    scores.mse = mse(reference, test);
    scores.psnr = psnr(scores.mse);
    scores.ssim = ssim(reference, test);
    return scores;
}

FrameScores average(std::span<const FrameScores> frames) {
    if (frames.empty())
        throw std::invalid_argument("averaging no frames");
    FrameScores result;
    PooledMean flip_mean, foveated_mean;
    result.ssim = 0.0;
    for (const FrameScores& frame : frames) {
        flip_mean.add(frame.flip);
        foveated_mean.add(frame.foveated);
        result.mse += frame.mse / static_cast<double>(frames.size());
        result.ssim += frame.ssim / static_cast<double>(frames.size());
    }
    result.flip = flip_mean.take();
    result.foveated = foveated_mean.take();
    result.psnr = psnr(result.mse);
    result.bands = average_bands(frames, &FrameScores::bands);
    result.foveated_bands = average_bands(frames, &FrameScores::foveated_bands);
    return result;
}

} // namespace macula::metric
