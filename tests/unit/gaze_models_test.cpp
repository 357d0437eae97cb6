// Fixed gaze, the synthetic observer, the moving target, and how they are written.
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/gaze/spec.hpp"

namespace macula::scene {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kSecond = 1000 * kMs;

TEST(FixedGaze, NeedsADirectionAndNormalisesIt) {
    EXPECT_EQ(fixed_gaze({0.0, 0.0, -5.0})->at(7).direction, glm::dvec3(0.0, 0.0, -1.0));
    EXPECT_EQ(fixed_gaze({0.0, 0.0, -5.0})->at(7).time_ns, 7);
    EXPECT_THROW(fixed_gaze({0.0, 0.0, 0.0}), std::invalid_argument);
    EXPECT_THROW(fixed_gaze({NAN, 0.0, -1.0}), std::invalid_argument);
}

TEST(Observer, AnyTimeFirstGivesTheSameGaze) {
    const GazePointer forward = synthetic_observer({.seed = 5});
    const GazePointer late = synthetic_observer({.seed = 5});
    const glm::dvec3 at_20 = late->at(20 * kSecond).direction;
    for (int i = 0; i < 2000; ++i)
        EXPECT_EQ(forward->at(i * 10 * kMs).direction, late->at(i * 10 * kMs).direction);
    EXPECT_EQ(forward->at(20 * kSecond).direction, at_20);
    EXPECT_NE(synthetic_observer({.seed = 6})->at(20 * kSecond).direction, at_20);
}

TEST(Observer, StaysWithinItsLimitAndMovesContinuously) {
    const GazePointer gaze =
        synthetic_observer({.seed = 2, .spread_degrees = 20, .limit_degrees = 15});
    glm::dvec3 last = gaze->at(0).direction;
    for (int ms = 0; ms < 60000; ++ms) {
        const glm::dvec3 now = gaze->at(ms * kMs).direction;
        EXPECT_LE(angle_degrees(now, {0.0, 0.0, -1.0}), 15.3); // azimuth and elevation as a plane
        // The fastest human saccades: below 1000 degrees a second.
        ASSERT_LT(angle_degrees(now, last), 1.0) << ms;
        last = now;
    }
}

// Times at which the eye starts and stops to move, found by sampling, against the main sequence.
TEST(Observer, SaccadesFollowTheMainSequence) {
    const GazePointer gaze = synthetic_observer({.seed = 9});
    constexpr std::int64_t step = kMs / 10;
    glm::dvec3 last = gaze->at(0).direction, from = last;
    std::int64_t start = 0;
    int saccades = 0;
    bool moving = false;
    for (std::int64_t t = step; t < 30 * kSecond; t += step) {
        const glm::dvec3 now = gaze->at(t).direction;
        const bool moves = angle_degrees(now, last) > 0.0;
        if (moves && !moving) {
            start = t - step;
            from = last;
        }
        if (!moves && moving) {
            const double amplitude = angle_degrees(from, now);
            const double ms = 1e-6 * static_cast<double>(t - step - start);
            EXPECT_NEAR(ms, saccade_ms(amplitude), 1.0) << amplitude << " degrees at " << t;
            ++saccades;
        }
        moving = moves;
        last = now;
    }
    // 300 ms a fixation and some 40 ms a saccade.
    EXPECT_GT(saccades, 60);
    EXPECT_LT(saccades, 110);
}

TEST(Observer, BlinksAreInvalidAndAsOftenAsAskedFor) {
    const GazePointer gaze = synthetic_observer({.seed = 1, .blinks_per_minute = 20});
    int invalid = 0, blinks = 0;
    bool last = true;
    for (int ms = 0; ms < 60000; ++ms) {
        const bool valid = gaze->at(ms * kMs).valid;
        invalid += valid ? 0 : 1;
        blinks += !valid && last ? 1 : 0;
        last = valid;
    }
    EXPECT_EQ(blinks, 20);
    EXPECT_NEAR(invalid, 20 * 150, 40);
}

TEST(Target, MovesLinearlyAtItsSpeedWithinItsRectangle) {
    const GazePointer gaze =
        moving_target({.seed = 4, .speed = 12, .half_width = 18, .half_height = 9}, {});
    const auto point = [&](std::int64_t t) {
        const glm::dvec3 d = gaze->at(t).direction;
        return glm::dvec2(d.x, d.y) / -d.z;
    };
    const double tangents_a_ms = 12.0 * 3.14159265358979 / 180.0 / 1000.0;
    int corners = 0;
    for (int ms = 1; ms < 30000; ++ms) {
        const glm::dvec2 here = point(ms * kMs);
        EXPECT_LE(std::fabs(here.x), std::tan(glm::radians(18.0)) + 1e-9);
        EXPECT_LE(std::fabs(here.y), std::tan(glm::radians(9.0)) + 1e-9);
        const glm::dvec2 before = point((ms - 1) * kMs), after = point((ms + 1) * kMs);
        ASSERT_LE(glm::length(after - here), tangents_a_ms * 1.0001);
        if (glm::length((after - here) - (here - before)) > 1e-9)
            ++corners;
        else
            EXPECT_NEAR(glm::length(after - here), tangents_a_ms, 1e-9) << ms;
    }
    EXPECT_GT(corners, 5);
    EXPECT_LT(corners, 100);
}

TEST(Target, EyesConvergeAtTheScenesDepth) {
    TargetOptions options{.seed = 4};
    const GazePointer gaze =
        moving_target(options, [](std::int64_t, const glm::dvec3&) { return 2.0; });
    const GazeSample s = gaze->at(3 * kSecond);
    const glm::dvec3 point = 2.0 * s.direction;
    EXPECT_NEAR(angle_degrees(*s.left, point - options.left_eye), 0.0, 1e-9);
    EXPECT_NEAR(angle_degrees(*s.right, point - options.right_eye), 0.0, 1e-9);
}

TEST(Target, WithoutAnythingThereTheEyesAreParallel) {
    const GazePointer gaze = moving_target({}, [](std::int64_t, const glm::dvec3&) {
        return std::numeric_limits<double>::infinity();
    });
    const GazeSample s = gaze->at(kSecond);
    EXPECT_EQ(*s.left, s.direction);
    EXPECT_EQ(*s.right, s.direction);
}

TEST(Target, DoesNotJumpAtSilhouettes) {
    // From 1 m to infinity at once, at one second.
    const GazePointer gaze = moving_target({}, [](std::int64_t t, const glm::dvec3&) {
        return t < kSecond ? 1.0 : std::numeric_limits<double>::infinity();
    });
    double vergence = 100.0;
    for (int ms = 500; ms < 1500; ++ms) {
        const GazeSample s = gaze->at(ms * kMs);
        const double now = angle_degrees(*s.left, *s.right);
        ASSERT_LT(std::fabs(now - vergence), ms == 500 ? 100.0 : 0.02) << ms;
        vergence = now;
    }
    EXPECT_NEAR(vergence, 0.0, 1e-6);
}

// --- the spellings ---

GazePointer parse(const std::string& text) {
    static const Display display = find_display("dk2");
    return parse_gaze(text, {display, Eye::left, {}});
}

TEST(GazeSpec, DegreesPixelsAndCentre) {
    EXPECT_NEAR(angles_of_direction(parse("10,-5.5")->at(0).direction).y, -5.5, 1e-12);
    EXPECT_EQ(parse("centre")->at(0).direction, glm::dvec3(0.0, 0.0, -1.0));
    const Display dk2 = find_display("dk2");
    EXPECT_NEAR(
        eccentricity(dk2, Eye::left, 100.5, 200.5, parse("pixel:100.5,200.5")->at(0).direction),
        0.0, 1e-9);
}

TEST(GazeSpec, SettingsReachTheModels) {
    EXPECT_THAT(parse("synthetic:seed=77")->describe(), HasSubstr("77"));
    EXPECT_THAT(parse("target:seed=12,speed=3,window=0")->describe(), HasSubstr("12"));
    EXPECT_NE(parse("synthetic:seed=1")->at(kSecond).direction,
              parse("synthetic:seed=1,spread=1")->at(kSecond).direction);
}

TEST(GazeSpec, WhatIsWrongIsNamed) {
    for (const char* bad : {"", "nonsense", "1,2,3", "200,0", "0,91", "nan,0", "pixel:-1,5",
                            "pixel:1", "pixel:2000,3", "synthetic:seed", "synthetic:sed=1",
                            "synthetic:seed=-1", "synthetic:fixation=1", "target:speed=fast",
                            "udp:", "udp:0", "udp:70000", "udp:12x", "synthetic:seed=1,,"})
        EXPECT_THROW(parse(bad), std::invalid_argument) << bad;
    EXPECT_THAT([] { parse("target:sped=3"); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("speed")));
    EXPECT_THROW(parse("/nonexistent/gaze.csv"), SceneError);
    EXPECT_THROW(parse("/nonexistent/gaze.csv:repeat"), SceneError);
}

TEST(TrackerSpec, KeysValuesAndRanges) {
    const TrackerOptions o = parse_tracker("latency=30,rate=120,dropout-ms=50,seed=9");
    EXPECT_EQ(o.latency_ms, 30.0);
    EXPECT_EQ(o.rate_hz, 120.0);
    EXPECT_EQ(o.dropout_ms, 50.0);
    EXPECT_EQ(o.seed, 9u);
    EXPECT_THROW(parse_tracker("latency"), std::invalid_argument);
    EXPECT_THROW(parse_tracker("latency=1e"), std::invalid_argument);
    EXPECT_THROW(tracked(fixed_gaze({0, 0, -1}), parse_tracker("latency=-1")),
                 std::invalid_argument);
    EXPECT_THROW(tracked(fixed_gaze({0, 0, -1}), parse_tracker("widen=0.5")),
                 std::invalid_argument);
}

} // namespace
} // namespace macula::scene
