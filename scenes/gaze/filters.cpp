// What the renderer does about a tracker's shortcomings: smoothing, and holding lost gaze.
#include <algorithm>
#include <cmath>

#include "scenes/gaze/tracker.hpp"

namespace macula::scene {
namespace {

constexpr std::int64_t kStepNs = 4'000'000; // 250 Hz
constexpr std::int64_t kSearchNs = 10'000'000'000;
constexpr std::int64_t kMemoryNs = 1'000'000'000; // of the widening
constexpr double kGrowNs = 50e6, kShrinkNs = 300e6;

class Smoothing : public GazeSource {
  public:
    Smoothing(GazePointer inner, std::int64_t window_ns, double saccade_degrees)
        : inner_(std::move(inner)), window_ns_(window_ns), saccade_degrees_(saccade_degrees) {}

    GazeSample at(std::int64_t time_ns) override {
        GazeSample newest = inner_->at(time_ns);
        if (!newest.valid)
            return newest;
        glm::dvec3 sum(0.0), left(0.0), right(0.0);
        for (std::int64_t back = 0; back <= window_ns_; back += kStepNs) {
            const GazeSample sample = inner_->at(time_ns - back);
            if (!sample.valid)
                continue;
            if (angle_degrees(sample.direction, newest.direction) > saccade_degrees_)
                break;
            sum += sample.direction;
            left += sample.of(Eye::left);
            right += sample.of(Eye::right);
        }
        newest.direction = glm::normalize(sum);
        if (newest.left)
            newest.left = glm::normalize(left);
        if (newest.right)
            newest.right = glm::normalize(right);
        return newest;
    }

    bool live() const override { return inner_->live(); }
    std::string status() const override { return inner_->status(); }
    std::string describe() const override { return inner_->describe(); }

  private:
    GazePointer inner_;
    std::int64_t window_ns_;
    double saccade_degrees_;
};

class Hold : public GazeSource {
  public:
    Hold(GazePointer inner, double most) : inner_(std::move(inner)), most_(most) {}

    GazeSample at(std::int64_t time_ns) override {
        GazeSample sample = inner_->at(time_ns);
        sample.widening = widening_at(time_ns, sample.valid);
        if (sample.valid)
            return sample;
        for (std::int64_t back = kStepNs; back <= kSearchNs; back += kStepNs) {
            const std::int64_t earlier = time_ns - back;
            if (earlier < 0 && back > kStepNs)
                break;
            const GazeSample last = inner_->at(std::max<std::int64_t>(earlier, 0));
            if (!last.valid)
                continue;
            sample.direction = last.direction;
            sample.left = last.left;
            sample.right = last.right;
            return sample;
        }
        sample.direction = glm::dvec3(0.0, 0.0, -1.0);
        sample.left = sample.right = std::nullopt;
        sample.widening = most_;
        return sample;
    }

    bool live() const override { return inner_->live(); }
    std::string status() const override { return inner_->status(); }
    std::string describe() const override { return inner_->describe(); }

  private:
    // Replays the last second: up while samples are invalid, down while they are valid.
    double widening_at(std::int64_t time_ns, bool valid_now) {
        double part = 0.0; // of the way from 1 to most_
        const std::int64_t steps =
            std::min(kMemoryNs, std::max<std::int64_t>(time_ns, 0)) / kStepNs;
        for (std::int64_t step = steps; step >= 0; --step) {
            const bool valid = step == 0 ? valid_now : inner_->at(time_ns - step * kStepNs).valid;
            part += static_cast<double>(kStepNs) * (valid ? -1.0 / kShrinkNs : 1.0 / kGrowNs);
            part = std::clamp(part, 0.0, 1.0);
        }
        return 1.0 + part * (most_ - 1.0);
    }

    GazePointer inner_;
    double most_;
};

} // namespace

GazePointer with_smoothing(GazePointer source, std::int64_t window_ns, double saccade_degrees) {
    return std::make_unique<Smoothing>(std::move(source), window_ns, saccade_degrees);
}

GazePointer with_hold(GazePointer source, double most) {
    return std::make_unique<Hold>(std::move(source), most);
}

} // namespace macula::scene
