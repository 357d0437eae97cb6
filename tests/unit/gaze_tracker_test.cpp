// What a tracker does to gaze, and what is done about it.
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "scenes/gaze/tracker.hpp"

namespace macula::scene {
namespace {

constexpr std::int64_t kMs = 1'000'000;

// Looks `speed` degrees a second to the right; invalid from `lost` to `found` ms.
class Ramp : public GazeSource {
  public:
    explicit Ramp(double speed, std::int64_t lost = 0, std::int64_t found = 0)
        : speed_(speed), lost_(lost * kMs), found_(found * kMs) {}
    GazeSample at(std::int64_t time_ns) override {
        GazeSample s;
        s.time_ns = time_ns;
        s.direction = direction_of_angles(speed_ * 1e-9 * static_cast<double>(time_ns), 0.0);
        s.valid = !(time_ns >= lost_ && time_ns < found_);
        if (!s.valid)
            s.direction = {0.0, 0.0, -1.0};
        return s;
    }
    std::string describe() const override { return "ramp"; }

  private:
    double speed_;
    std::int64_t lost_, found_;
};

GazePointer ramp(double speed, std::int64_t lost = 0, std::int64_t found = 0) {
    return std::make_unique<Ramp>(speed, lost, found);
}

double azimuth(const GazeSample& sample) {
    return angles_of_direction(sample.direction).x;
}

TEST(Latency, ShowsThePastUnderItsOwnTime) {
    const GazePointer gaze = with_latency(ramp(10.0), 40 * kMs);
    EXPECT_NEAR(azimuth(gaze->at(1000 * kMs)), 9.6, 1e-9);
    EXPECT_EQ(gaze->at(1000 * kMs).time_ns, 960 * kMs);
}

TEST(Rate, HoldsBetweenMeasurements) {
    const GazePointer gaze = with_rate(ramp(10.0), 50.0);
    EXPECT_EQ(gaze->at(19 * kMs).time_ns, 0);
    EXPECT_EQ(gaze->at(20 * kMs).time_ns, 20 * kMs);
    EXPECT_EQ(gaze->at(39 * kMs + 999'999).time_ns, 20 * kMs);
    const GazePointer odd = with_rate(ramp(10.0), 75.0);
    for (std::int64_t t = 0; t < 1000 * kMs; t += 777'777) {
        EXPECT_LE(odd->at(t).time_ns, t);
        EXPECT_GT(odd->at(t).time_ns, t - 13'333'335);
    }
}

TEST(Noise, HasItsStandardDeviationAndBelongsToTheSample) {
    const GazePointer gaze = with_noise(with_rate(ramp(0.0), 1000.0), 0.5, 3);
    double sum_x = 0.0, sum_y = 0.0;
    constexpr int kCount = 20000;
    for (int i = 0; i < kCount; ++i) {
        const glm::dvec2 a = angles_of_direction(gaze->at(i * kMs).direction);
        sum_x += a.x * a.x;
        sum_y += a.y * a.y;
    }
    EXPECT_NEAR(std::sqrt(sum_x / kCount), 0.5, 0.01);
    EXPECT_NEAR(std::sqrt(sum_y / kCount), 0.5, 0.01);
    EXPECT_EQ(gaze->at(5 * kMs).direction, gaze->at(5 * kMs + 10).direction);
    EXPECT_NE(gaze->at(5 * kMs).direction, gaze->at(6 * kMs).direction);
}

TEST(Quantisation, GivesMultiples) {
    const GazePointer gaze = with_quantisation(ramp(10.0), 0.25);
    EXPECT_NEAR(azimuth(gaze->at(110 * kMs)), 1.0, 1e-9);
    EXPECT_NEAR(azimuth(gaze->at(130 * kMs)), 1.25, 1e-9);
}

TEST(Dropouts, LoseTheirPartOfTheTimeInWholeStretches) {
    const GazePointer gaze = with_dropouts(ramp(1.0), 0.2, 50 * kMs, 8);
    int lost = 0;
    for (int stretch = 0; stretch < 4000; ++stretch) {
        const bool valid = gaze->at(stretch * 50 * kMs).valid;
        EXPECT_EQ(gaze->at(stretch * 50 * kMs + 49 * kMs).valid, valid);
        lost += valid ? 0 : 1;
    }
    EXPECT_NEAR(lost, 800, 80);
    EXPECT_TRUE(with_dropouts(ramp(1.0), 0.0, kMs, 8)->at(0).valid);
    EXPECT_FALSE(with_dropouts(ramp(1.0), 1.0, kMs, 8)->at(0).valid);
}

TEST(Smoothing, DelaysSlowMovementsByHalfItsWindow) {
    const GazePointer gaze = with_smoothing(ramp(10.0), 40 * kMs, 3.0);
    EXPECT_NEAR(azimuth(gaze->at(1000 * kMs)), 10.0 * 0.980, 1e-3);
}

TEST(Smoothing, TakesNoiseAway) {
    const GazePointer raw = with_noise(ramp(0.0), 0.5, 3);
    const GazePointer smooth = with_smoothing(with_noise(ramp(0.0), 0.5, 3), 96 * kMs, 10.0);
    double before = 0.0, after = 0.0;
    for (int i = 0; i < 1000; ++i) {
        const std::int64_t t = 1000 * kMs + i * 13 * kMs;
        before += std::pow(azimuth(raw->at(t)), 2.0);
        after += std::pow(azimuth(smooth->at(t)), 2.0);
    }
    // The mean of 25 independent samples.
    EXPECT_NEAR(std::sqrt(after / before), 0.2, 0.03);
}

// A step of 10 degrees at one second.
class Step : public GazeSource {
  public:
    GazeSample at(std::int64_t time_ns) override {
        GazeSample s;
        s.time_ns = time_ns;
        s.direction = direction_of_angles(time_ns < 1000 * kMs ? 0.0 : 10.0, 0.0);
        return s;
    }
    std::string describe() const override { return "step"; }
};

TEST(Smoothing, LetsSaccadesPassAtOnce) {
    const GazePointer gaze = with_smoothing(std::make_unique<Step>(), 100 * kMs, 3.0);
    EXPECT_NEAR(azimuth(gaze->at(999 * kMs)), 0.0, 1e-9);
    EXPECT_NEAR(azimuth(gaze->at(1000 * kMs)), 10.0, 1e-9);
}

TEST(Hold, AnInvalidSampleKeepsTheLastDirectionAndNeverTheCentre) {
    const GazePointer gaze = with_hold(ramp(10.0, 1000, 2000), 2.0);
    for (std::int64_t ms = 1000; ms < 2000; ms += 7) {
        const GazeSample s = gaze->at(ms * kMs);
        EXPECT_FALSE(s.valid);
        EXPECT_NEAR(azimuth(s), 10.0, 0.05) << ms;
    }
    EXPECT_NEAR(azimuth(gaze->at(2000 * kMs)), 20.0, 1e-9);
}

TEST(Hold, WidensWhileLostAndForAWhileAfter) {
    const GazePointer gaze = with_hold(ramp(10.0, 1000, 2000), 2.0);
    const auto widening = [&](std::int64_t ms) { return gaze->at(ms * kMs).widening; };
    EXPECT_EQ(widening(999), 1.0);
    EXPECT_GT(widening(1000), 1.0);
    EXPECT_NEAR(widening(1060), 2.0, 1e-9);
    EXPECT_NEAR(widening(1999), 2.0, 1e-9);
    EXPECT_NEAR(widening(2150), 1.5, 0.02);
    EXPECT_EQ(widening(2400), 1.0);
}

TEST(Hold, AShortBlinkWidensOnlyALittle) {
    const GazePointer gaze = with_hold(ramp(10.0, 1000, 1010), 2.0);
    EXPECT_LT(gaze->at(1012 * kMs).widening, 1.3);
    EXPECT_GT(gaze->at(1012 * kMs).widening, 1.0);
}

TEST(Hold, WithNothingBeforeIsStraightAheadAtTheFullWidening) {
    const GazePointer gaze = with_hold(ramp(10.0, -1, 500), 3.0);
    const GazeSample s = gaze->at(0);
    EXPECT_FALSE(s.valid);
    EXPECT_EQ(s.direction, glm::dvec3(0.0, 0.0, -1.0));
    EXPECT_EQ(s.widening, 3.0);
}

TEST(Tracked, IsAFunctionOfTimeWhateverWasAskedBefore) {
    const TrackerOptions o{.latency_ms = 23,
                           .rate_hz = 90,
                           .noise_degrees = 0.4,
                           .quantum_degrees = 0.05,
                           .dropout = 0.1,
                           .smooth_ms = 30};
    const GazePointer forward = tracked(ramp(5.0), o), jumping = tracked(ramp(5.0), o);
    jumping->at(3000 * kMs);
    for (std::int64_t t = 0; t < 2000; t += 13) {
        const GazeSample a = forward->at(t * kMs), b = jumping->at((1999 - t) * kMs);
        EXPECT_EQ(a.direction, jumping->at(t * kMs).direction);
        EXPECT_EQ(b.widening, forward->at((1999 - t) * kMs).widening);
        EXPECT_NEAR(glm::length(a.direction), 1.0, 1e-12);
    }
}

// A live source delivers whatever is newest, whenever it is asked.
class Live : public GazeSource {
  public:
    GazeSample at(std::int64_t time_ns) override {
        GazeSample s;
        s.time_ns = time_ns;
        s.direction = direction_of_angles(static_cast<double>(calls_++), 0.0);
        return s;
    }
    bool live() const override { return true; }
    std::string describe() const override { return "live"; }

  private:
    int calls_ = 0;
};

TEST(Tracked, LatencyOfALiveSourceIsReal) {
    const GazePointer gaze = tracked(std::make_unique<Live>(), {.latency_ms = 30});
    gaze->at(0);
    const double at_10 = azimuth(gaze->at(10 * kMs));
    (void)at_10;
    const GazeSample later = gaze->at(40 * kMs);
    EXPECT_EQ(later.time_ns, 10 * kMs);
}

} // namespace
} // namespace macula::scene
