#include "host/metric/temporal.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "host/metric/flip_colour.hpp"

namespace macula::metric {
namespace {

ScalarMap lightness(const Picture& picture) {
    ScalarMap map(picture.width, picture.height);
    tbb::parallel_for(std::size_t{0}, std::size_t{picture.height}, [&](std::size_t y) {
        for (std::size_t i = y * picture.width; i < (y + 1) * picture.width; ++i) {
            const float* rgb = &picture.rgb[3 * i];
            const float luminance = xyz_of_rgb(clamped({rgb[0], rgb[1], rgb[2]})).y;
            map.values[i] = 1.16f * lab_curve(luminance) - 0.16f;
        }
    });
    return map;
}

/// A place between four pixels.
struct Place {
    std::size_t upper_left, right, down; // index, and steps to the neighbours (0 at the edges)
    float fx, fy;

    float read(const ScalarMap& map) const {
        const float* p = &map.values[upper_left];
        const float above = p[0] + (p[right] - p[0]) * fx;
        const float below = p[down] + (p[down + right] - p[down]) * fx;
        return above + (below - above) * fy;
    }
};

/// Nothing where (x, y), in pixels with pixel (0, 0)'s centre at (0, 0), lies outside the picture.
std::optional<Place> place(const ScalarMap& map, float x, float y) {
    const auto width = static_cast<float>(map.width), height = static_cast<float>(map.height);
    if (!(x >= -0.5f && x <= width - 0.5f && y >= -0.5f && y <= height - 0.5f))
        return {};
    const float cx = std::clamp(x, 0.0f, width - 1.0f), cy = std::clamp(y, 0.0f, height - 1.0f);
    const auto ix = static_cast<std::uint32_t>(cx), iy = static_cast<std::uint32_t>(cy);
    return Place{std::size_t{iy} * map.width + ix, ix + 1 < map.width ? std::size_t{1} : 0,
                 iy + 1 < map.height ? std::size_t{map.width} : 0, cx - static_cast<float>(ix),
                 cy - static_cast<float>(iy)};
}

void check_motion(const Picture& picture, const MotionField& motion) {
    if (motion.width != picture.width || motion.height != picture.height ||
        motion.xy.size() != 2 * picture.pixels())
        throw std::invalid_argument(fmt::format("motion of {} x {} pixels for a picture of {} x {}",
                                                motion.width, motion.height, picture.width,
                                                picture.height));
}

} // namespace

TemporalScores::TemporalScores(std::vector<Band> bands)
    : bands_(std::move(bands)), sums_(bands_.size() + 1) {}

std::vector<TemporalScore> TemporalScores::add(const Picture& reference, const Picture& test,
                                               const ScalarMap& eccentricity,
                                               const MotionField* motion) {
    check_pair(reference, test);
    check_map(reference, eccentricity, "eccentricities");
    if (motion != nullptr)
        check_motion(reference, *motion);
    if (frames_ > 0 &&
        (reference.width != reference_.width || reference.height != reference_.height))
        throw std::invalid_argument(fmt::format("a frame of {} x {} pixels after one of {} x {}",
                                                reference.width, reference.height, reference_.width,
                                                reference_.height));
    ScalarMap r = lightness(reference), t = lightness(test);
    std::vector<Sum> sums(sums_.size());
    if (frames_ > 0)
        sums = changes(r, t, eccentricity, motion);
    for (std::size_t b = 0; b < sums.size(); ++b)
        sums_[b].add(sums[b]);
    reference_ = std::move(r);
    test_ = std::move(t);
    ++frames_;
    return scores_of(sums);
}

std::vector<TemporalScores::Sum> TemporalScores::changes(const ScalarMap& reference,
                                                         const ScalarMap& test,
                                                         const ScalarMap& eccentricity,
                                                         const MotionField* motion) const {
    // Row by row, and the rows in their order: the same for all numbers of threads.
    std::vector<std::vector<Sum>> rows(reference.height, std::vector<Sum>(sums_.size()));
    tbb::parallel_for(std::uint32_t{0}, reference.height, [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < reference.width; ++x) {
            const std::size_t i = std::size_t{y} * reference.width + x;
            const float mx = motion != nullptr ? motion->xy[2 * i] : 0.0f;
            const float my = motion != nullptr ? motion->xy[2 * i + 1] : 0.0f;
            const auto before =
                place(reference, static_cast<float>(x) + mx, static_cast<float>(y) + my);
            if (!before)
                continue;
            const double dr = double{reference.values[i]} - before->read(reference_);
            const double dt = double{test.values[i]} - before->read(test_);
            const Sum change{1, std::fabs(dt) - std::fabs(dr), 0.5 * (dt - dr) * (dt - dr)};
            rows[y].back().add(change);
            for (std::size_t b = 0; b < bands_.size(); ++b) {
                if (bands_[b].contains(eccentricity.values[i]))
                    rows[y][b].add(change);
            }
        }
    });
    std::vector<Sum> sums(sums_.size());
    for (const auto& row : rows) {
        for (std::size_t b = 0; b < sums.size(); ++b)
            sums[b].add(row[b]);
    }
    return sums;
}

std::vector<TemporalScore> TemporalScores::total() const {
    return scores_of(sums_);
}

std::vector<TemporalScore> TemporalScores::scores_of(std::span<const Sum> sums) const {
    std::vector<TemporalScore> scores;
    for (std::size_t b = 0; b < sums.size(); ++b) {
        const double count = std::max<double>(1.0, static_cast<double>(sums[b].pixels));
        scores.push_back({b < bands_.size() ? bands_[b] : Band{"all", 0.0, 180.1}, sums[b].pixels,
                          sums[b].instability / count, sums[b].energy / count});
    }
    return scores;
}

} // namespace macula::metric
