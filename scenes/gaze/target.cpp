#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "scenes/gaze/models.hpp"
#include "scenes/gaze/random.hpp"

namespace macula::scene {
namespace {

constexpr std::int64_t kDepthStepNs = 50'000'000; // between the depths that are averaged
constexpr std::size_t kKeptDepths = 4096;
constexpr double kNearestMetres = 0.1; // nobody's eyes converge on less
constexpr std::int64_t kMaxTimeNs = std::int64_t{24} * 3600 * 1'000'000'000;

double tangent(double degrees) {
    return std::tan(degrees * std::numbers::pi / 180.0);
}

struct Corner {
    glm::dvec2 point; // of the image plane at distance 1
    double time_s;
};

class Target : public GazeSource {
  public:
    Target(const TargetOptions& options, DepthFunction depth)
        : options_(options), depth_(std::move(depth)), corners_{{{0.0, 0.0}, 0.0}} {}

    GazeSample at(std::int64_t time_ns) override {
        const std::int64_t t = std::clamp<std::int64_t>(time_ns, 0, kMaxTimeNs);
        GazeSample sample;
        sample.time_ns = time_ns;
        sample.direction = direction_at(t);
        const double vergence = vergence_at(t);
        // The point is direction / vergence; scaled by vergence it may be infinitely far away.
        sample.left = glm::normalize(sample.direction - options_.left_eye * vergence);
        sample.right = glm::normalize(sample.direction - options_.right_eye * vergence);
        return sample;
    }

    std::string describe() const override {
        return "moving target, seed " + std::to_string(options_.seed);
    }

  private:
    glm::dvec2 corner(std::uint64_t index) const {
        return {tangent(options_.half_width) * (2.0 * gaze_uniform(options_.seed, index, 0) - 1.0),
                tangent(options_.half_height) *
                    (2.0 * gaze_uniform(options_.seed, index, 1) - 1.0)};
    }

    glm::dvec3 direction_at(std::int64_t time_ns) {
        const double t = 1e-9 * static_cast<double>(time_ns);
        const double speed = options_.speed * std::numbers::pi / 180.0; // tangents a second
        while (corners_.back().time_s <= t) {
            const glm::dvec2 next = corner(corners_.size());
            const double length = glm::length(next - corners_.back().point);
            corners_.push_back({next, corners_.back().time_s + std::max(length / speed, 1e-3)});
        }
        const auto after =
            std::upper_bound(corners_.begin(), corners_.end(), t,
                             [](double wanted, const Corner& c) { return wanted < c.time_s; });
        const Corner &from = *std::prev(after), &to = *after;
        const glm::dvec2 point =
            glm::mix(from.point, to.point, (t - from.time_s) / (to.time_s - from.time_s));
        return glm::normalize(glm::dvec3(point, -1.0));
    }

    // 1 / metres at a multiple of the step.
    double sampled_vergence(std::int64_t step) {
        const auto known = vergences_.find(step);
        if (known != vergences_.end())
            return known->second;
        const std::int64_t time = std::max<std::int64_t>(step, 0) * kDepthStepNs;
        const double metres = depth_(time, direction_at(time));
        const double vergence = std::isnan(metres) ? 0.0 : 1.0 / std::max(metres, kNearestMetres);
        if (vergences_.size() >= kKeptDepths)
            vergences_.erase(vergences_.begin());
        vergences_[step] = vergence;
        return vergence;
    }

    // Mean over the window about `time_ns` of the depths' linear interpolation, approximated by
    // steps that enter and leave gradually.
    double vergence_at(std::int64_t time_ns) {
        if (!depth_)
            return 0.0;
        const double half = 0.5e6 * options_.depth_window_ms + kDepthStepNs;
        const auto steps = static_cast<std::int64_t>(half / kDepthStepNs) + 1;
        const std::int64_t middle = time_ns / kDepthStepNs;
        double sum = 0.0, weights = 0.0;
        for (std::int64_t step = middle - steps; step <= middle + steps; ++step) {
            const double away = std::fabs(static_cast<double>(step * kDepthStepNs - time_ns));
            const double weight = std::clamp((half - away) / kDepthStepNs, 0.0, 1.0);
            if (!(weight > 0.0))
                continue;
            sum += weight * sampled_vergence(step);
            weights += weight;
        }
        return sum / weights;
    }

    TargetOptions options_;
    DepthFunction depth_;
    std::vector<Corner> corners_;
    std::map<std::int64_t, double> vergences_; // the earliest are forgotten first
};

void check_range(const char* what, double value, double least, double most) {
    if (!(value >= least && value <= most))
        throw std::invalid_argument("moving target: " + std::string(what) + " must be " +
                                    std::to_string(least) + " to " + std::to_string(most));
}

} // namespace

GazePointer moving_target(const TargetOptions& options, DepthFunction depth) {
    check_range("speed", options.speed, 0.1, 200.0);
    check_range("width", options.half_width, 1.0, 60.0);
    check_range("height", options.half_height, 1.0, 60.0);
    check_range("window", options.depth_window_ms, 0.0, 5000.0);
    return std::make_unique<Target>(options, std::move(depth));
}

} // namespace macula::scene
