#include "scenes/gaze/tracker.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <stdexcept>

#include "scenes/gaze/random.hpp"

namespace macula::scene {

glm::dvec3 turned(const glm::dvec3& direction, const glm::dvec2& degrees) {
    glm::dvec3 right = glm::cross(direction, glm::dvec3(0.0, 1.0, 0.0));
    if (glm::length(right) < 1e-9)
        right = glm::dvec3(1.0, 0.0, 0.0);
    right = glm::normalize(right);
    const glm::dvec3 up = glm::cross(right, direction);
    const glm::dvec2 angle = glm::radians(degrees);
    const double size = glm::length(angle);
    if (!(size > 0.0))
        return direction;
    const glm::dvec3 sideways = (right * angle.x + up * angle.y) / size;
    return glm::normalize(direction * std::cos(size) + sideways * std::sin(size));
}

namespace {

class Wrapper : public GazeSource {
  public:
    explicit Wrapper(GazePointer inner) : inner_(std::move(inner)) {}
    bool live() const override { return inner_->live(); }
    std::string status() const override { return inner_->status(); }
    std::string describe() const override { return inner_->describe(); }

  protected:
    GazePointer inner_;
};

// Applies a function to all directions of a valid sample.
template <typename Change>
void change_directions(GazeSample& sample, Change&& change) {
    if (!sample.valid)
        return;
    sample.direction = change(sample.direction);
    if (sample.left)
        sample.left = change(*sample.left);
    if (sample.right)
        sample.right = change(*sample.right);
}

class Latency : public Wrapper {
  public:
    Latency(GazePointer inner, std::int64_t latency_ns)
        : Wrapper(std::move(inner)), latency_ns_(latency_ns) {}
    GazeSample at(std::int64_t time_ns) override {
        if (inner_->live())
            inner_->at(time_ns); // takes in what arrived
        return inner_->at(time_ns - latency_ns_);
    }

  private:
    std::int64_t latency_ns_;
};

class Rate : public Wrapper {
  public:
    Rate(GazePointer inner, double hz) : Wrapper(std::move(inner)), period_ns_(1e9 / hz) {}
    GazeSample at(std::int64_t time_ns) override {
        const double tick = std::floor((static_cast<double>(time_ns) + 0.5) / period_ns_);
        return inner_->at(
            std::min(std::llround(tick * period_ns_), static_cast<long long>(time_ns)));
    }

  private:
    double period_ns_;
};

class Noise : public Wrapper {
  public:
    Noise(GazePointer inner, double degrees, std::uint64_t seed)
        : Wrapper(std::move(inner)), degrees_(degrees), seed_(seed) {}
    GazeSample at(std::int64_t time_ns) override {
        GazeSample sample = inner_->at(time_ns);
        const glm::dvec2 offset =
            degrees_ * gaze_normal(seed_, static_cast<std::uint64_t>(sample.time_ns), 0x6e6f);
        change_directions(sample, [&](const glm::dvec3& d) { return turned(d, offset); });
        return sample;
    }

  private:
    double degrees_;
    std::uint64_t seed_;
};

class Quantisation : public Wrapper {
  public:
    Quantisation(GazePointer inner, double degrees)
        : Wrapper(std::move(inner)), degrees_(degrees) {}
    GazeSample at(std::int64_t time_ns) override {
        GazeSample sample = inner_->at(time_ns);
        change_directions(sample, [&](const glm::dvec3& d) {
            const glm::dvec2 steps = glm::round(angles_of_direction(d) / degrees_) * degrees_;
            return direction_of_angles(steps.x, std::clamp(steps.y, -90.0, 90.0));
        });
        return sample;
    }

  private:
    double degrees_;
};

class Dropouts : public Wrapper {
  public:
    Dropouts(GazePointer inner, double probability, std::int64_t length_ns, std::uint64_t seed)
        : Wrapper(std::move(inner)), probability_(probability), length_ns_(length_ns), seed_(seed) {
    }
    GazeSample at(std::int64_t time_ns) override {
        GazeSample sample = inner_->at(time_ns);
        const auto stretch = static_cast<std::uint64_t>(sample.time_ns / length_ns_);
        if (gaze_uniform(seed_, stretch, 0x6472) < probability_) {
            sample.valid = false;
            sample.confidence = 0.0;
        }
        return sample;
    }

  private:
    double probability_;
    std::int64_t length_ns_;
    std::uint64_t seed_;
};

class History : public Wrapper {
  public:
    using Wrapper::Wrapper;
    GazeSample at(std::int64_t time_ns) override {
        if (past_.empty() || time_ns >= past_.back().asked_ns) {
            past_.push_back({time_ns, inner_->at(time_ns)});
            while (past_.front().asked_ns < time_ns - kKeptNs)
                past_.pop_front();
        }
        const auto after = std::upper_bound(
            past_.begin(), past_.end(), time_ns,
            [](std::int64_t wanted, const Entry& entry) { return wanted < entry.asked_ns; });
        if (after != past_.begin())
            return std::prev(after)->sample;
        GazeSample unknown;
        unknown.time_ns = time_ns;
        unknown.valid = false;
        unknown.confidence = 0.0;
        return unknown;
    }

  private:
    static constexpr std::int64_t kKeptNs = 12'000'000'000;
    struct Entry {
        std::int64_t asked_ns;
        GazeSample sample;
    };
    std::deque<Entry> past_;
};

void check_range(const char* what, double value, double least, double most) {
    if (!(value >= least && value <= most))
        throw std::invalid_argument("tracker: " + std::string(what) + " must be " +
                                    std::to_string(least) + " to " + std::to_string(most) +
                                    ", not " + std::to_string(value));
}

void check(const TrackerOptions& o) {
    check_range("latency", o.latency_ms, 0.0, 1000.0);
    check_range("rate", o.rate_hz, 0.0, 10000.0);
    check_range("noise", o.noise_degrees, 0.0, 20.0);
    check_range("quantum", o.quantum_degrees, 0.0, 20.0);
    check_range("dropout", o.dropout, 0.0, 1.0);
    check_range("dropout-ms", o.dropout_ms, 1.0, 10000.0);
    check_range("smooth", o.smooth_ms, 0.0, 1000.0);
    check_range("saccade", o.saccade_degrees, 0.1, 180.0);
    check_range("widen", o.widening, 1.0, 10.0);
}

} // namespace

GazePointer with_latency(GazePointer source, std::int64_t latency_ns) {
    return std::make_unique<Latency>(std::move(source), latency_ns);
}

GazePointer with_rate(GazePointer source, double hz) {
    return std::make_unique<Rate>(std::move(source), hz);
}

GazePointer with_noise(GazePointer source, double degrees, std::uint64_t seed) {
    return std::make_unique<Noise>(std::move(source), degrees, seed);
}

GazePointer with_quantisation(GazePointer source, double degrees) {
    return std::make_unique<Quantisation>(std::move(source), degrees);
}

GazePointer with_dropouts(GazePointer source, double probability, std::int64_t length_ns,
                          std::uint64_t seed) {
    return std::make_unique<Dropouts>(std::move(source), probability, length_ns, seed);
}

GazePointer with_history(GazePointer source) {
    return std::make_unique<History>(std::move(source));
}

GazePointer tracked(GazePointer source, const TrackerOptions& o) {
    constexpr double kMs = 1e6;
    check(o);
    if (source->live())
        source = with_history(std::move(source));
    if (o.rate_hz > 0.0)
        source = with_rate(std::move(source), o.rate_hz);
    if (o.noise_degrees > 0.0)
        source = with_noise(std::move(source), o.noise_degrees, o.seed);
    if (o.quantum_degrees > 0.0)
        source = with_quantisation(std::move(source), o.quantum_degrees);
    if (o.dropout > 0.0)
        source =
            with_dropouts(std::move(source), o.dropout, std::llround(kMs * o.dropout_ms), o.seed);
    if (o.latency_ms > 0.0)
        source = with_latency(std::move(source), std::llround(kMs * o.latency_ms));
    if (o.smooth_ms > 0.0)
        source =
            with_smoothing(std::move(source), std::llround(kMs * o.smooth_ms), o.saccade_degrees);
    return with_hold(std::move(source), o.widening);
}

} // namespace macula::scene
