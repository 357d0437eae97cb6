#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "scenes/gaze/models.hpp"
#include "scenes/gaze/random.hpp"

namespace macula::scene {
namespace {

constexpr double kFixationSpread = 0.4; // of the duration's logarithm
constexpr double kShortestFixationMs = 80.0;
constexpr double kBlinkMs = 150.0;
constexpr std::int64_t kMaxTimeNs = std::int64_t{24} * 3600 * 1'000'000'000;

enum Dimension : std::uint64_t { kGoal = 0, kDuration = 1000, kBlink = 2000 };

// Course of a minimum-jerk movement: 0 to 1 with speed and acceleration 0 at both ends.
double minimum_jerk(double t) {
    return t * t * t * (10.0 + t * (-15.0 + 6.0 * t));
}

struct Fixation {
    std::int64_t start_ns, end_ns; // the saccade to the next one begins at its end
    glm::dvec2 angles;             // degrees
};

class Observer : public GazeSource {
  public:
    explicit Observer(const ObserverOptions& options) : options_(options) {
        fixations_.push_back({0, duration(0), {0.0, 0.0}});
    }

    GazeSample at(std::int64_t time_ns) override {
        const std::int64_t t = std::clamp<std::int64_t>(time_ns, 0, kMaxTimeNs);
        while (fixations_.back().end_ns <= t)
            add_fixation();
        auto here = std::upper_bound(
            fixations_.begin(), fixations_.end(), t,
            [](std::int64_t wanted, const Fixation& f) { return wanted < f.start_ns; });
        --here;
        GazeSample sample;
        sample.time_ns = time_ns;
        sample.direction = direction_at(*here, t);
        if (blinks(t)) {
            sample.valid = false;
            sample.confidence = 0.0;
        }
        return sample;
    }

    std::string describe() const override {
        return "synthetic observer, seed " + std::to_string(options_.seed);
    }

  private:
    std::int64_t duration(std::uint64_t index) const {
        const double normal = gaze_normal(options_.seed, index, kDuration).x;
        const double ms = options_.fixation_ms * std::exp(kFixationSpread * normal);
        return std::llround(1e6 * std::max(ms, kShortestFixationMs));
    }

    glm::dvec2 goal(std::uint64_t index) const {
        // Rejection, in as many dimensions as it takes; the last resort is the limit itself.
        glm::dvec2 angles(0.0);
        for (std::uint64_t attempt = 0; attempt < 64; ++attempt) {
            angles =
                options_.spread_degrees * gaze_normal(options_.seed, index, kGoal + 2 * attempt);
            if (glm::length(angles) <= options_.limit_degrees)
                return angles;
        }
        return glm::normalize(angles) * options_.limit_degrees;
    }

    void add_fixation() {
        const Fixation last = fixations_.back();
        const std::uint64_t index = fixations_.size();
        const glm::dvec2 angles = goal(index);
        const double amplitude = angle_degrees(direction_of_angles(last.angles.x, last.angles.y),
                                               direction_of_angles(angles.x, angles.y));
        const std::int64_t start = last.end_ns + std::llround(1e6 * saccade_ms(amplitude));
        fixations_.push_back({start, start + duration(index), angles});
    }

    // During the saccade that ends `from`, the eye is on its way to the next one.
    glm::dvec3 direction_at(const Fixation& from, std::int64_t t) {
        if (t < from.end_ns)
            return direction_of_angles(from.angles.x, from.angles.y);
        const Fixation& to = *(&from + 1); // there is one: the last one's end lies after t
        const double part =
            static_cast<double>(t - from.end_ns) / static_cast<double>(to.start_ns - from.end_ns);
        const glm::dvec2 angles = glm::mix(from.angles, to.angles, minimum_jerk(part));
        return direction_of_angles(angles.x, angles.y);
    }

    // One blink in each interval, at a random time of it.
    bool blinks(std::int64_t t) const {
        if (!(options_.blinks_per_minute > 0.0))
            return false;
        const double ms = 1e-6 * static_cast<double>(t);
        const double interval = 60000.0 / options_.blinks_per_minute;
        const double index = std::floor(ms / interval);
        const double start =
            gaze_uniform(options_.seed, static_cast<std::uint64_t>(index), kBlink) *
            (interval - kBlinkMs);
        const double inside = ms - index * interval;
        return inside >= start && inside < start + kBlinkMs;
    }

    ObserverOptions options_;
    std::vector<Fixation> fixations_;
};

void check_range(const char* what, double value, double least, double most) {
    if (!(value >= least && value <= most))
        throw std::invalid_argument("synthetic gaze: " + std::string(what) + " must be " +
                                    std::to_string(least) + " to " + std::to_string(most));
}

} // namespace

double saccade_ms(double degrees) {
    return 2.2 * degrees + 21.0;
}

GazePointer synthetic_observer(const ObserverOptions& options) {
    check_range("fixation", options.fixation_ms, 50.0, 10000.0);
    check_range("spread", options.spread_degrees, 0.0, 40.0);
    check_range("limit", options.limit_degrees, 1.0, 45.0);
    check_range("blinks", options.blinks_per_minute, 0.0, 60.0);
    return std::make_unique<Observer>(options);
}

} // namespace macula::scene
