// Changes from frame to frame, by hand.
#include <cmath>

#include <gtest/gtest.h>

#include <tbb/global_control.h>

#include "host/metric/flip.hpp"
#include "host/metric/pool.hpp"
#include "host/metric/temporal.hpp"
#include "tests/support/pictures.hpp"

namespace macula::metric {
namespace {

using test::noise;
using test::plain;

// A grey of CIE lightness `l` (0..1, above 0.08).
Picture grey(double l, std::uint32_t width = 12, std::uint32_t height = 9) {
    const auto y = static_cast<float>(std::pow((100.0 * l + 16.0) / 116.0, 3.0));
    return plain(width, height, y, y, y);
}

const ScalarMap kLooking(12, 9, 1.0f); // all in the fovea

TEST(Temporal, TheFirstFrameSaysNothing) {
    TemporalScores scores;
    for (const TemporalScore& score : scores.add(grey(0.5), grey(0.6), kLooking))
        EXPECT_EQ(score.pixels, 0u);
    EXPECT_EQ(scores.total().back().pixels, 0u);
    EXPECT_EQ(scores.total().back().instability, 0.0);
}

TEST(Temporal, AStillErrorIsNoFlicker) {
    TemporalScores scores;
    for (int frame = 0; frame < 4; ++frame)
        scores.add(grey(0.5), grey(0.7), kLooking);
    EXPECT_EQ(scores.total().back().pixels, 3u * 12 * 9);
    EXPECT_EQ(scores.total().back().instability, 0.0);
    EXPECT_EQ(scores.total().back().flicker_energy, 0.0);
}

TEST(Temporal, AFlickerHasTheEnergyOfItsSteps) {
    // 0.1 up and down: every step is 0.2, half its square 0.02.
    TemporalScores scores;
    for (int frame = 0; frame < 5; ++frame)
        scores.add(grey(0.5), grey(frame % 2 == 0 ? 0.4 : 0.6), kLooking);
    EXPECT_NEAR(scores.total().back().instability, 0.2, 1e-5);
    EXPECT_NEAR(scores.total().back().flicker_energy, 0.02, 1e-6);
    EXPECT_EQ(scores.total()[0].pixels, 4u * 12 * 9) << "all of them in the fovea";
    EXPECT_EQ(scores.total()[3].pixels, 0u);
}

TEST(Temporal, AFlickeringCopyScoresWorseThanItsStillAverage) {
    const Picture reference = noise(40, 30, 1);
    const ScalarMap looking(40, 30, 1.0f);
    Picture up = reference, down = reference, average = reference;
    for (std::size_t i = 0; i < up.rgb.size(); ++i) {
        up.rgb[i] = 0.5f * reference.rgb[i] + 0.2f;
        down.rgb[i] = 0.5f * reference.rgb[i] + 0.1f;
        average.rgb[i] = 0.5f * (up.rgb[i] + down.rgb[i]);
    }
    TemporalScores flickering, still;
    for (int frame = 0; frame < 6; ++frame) {
        flickering.add(reference, frame % 2 == 0 ? up : down, looking);
        still.add(reference, average, looking);
    }
    EXPECT_GT(flickering.total().back().instability, still.total().back().instability + 0.01);
    EXPECT_GT(flickering.total().back().flicker_energy, 1e-4);
    EXPECT_EQ(still.total().back().flicker_energy, 0.0);
}

TEST(Temporal, WhatTheReferenceChangesTooIsNoFault) {
    TemporalScores scores;
    for (int frame = 0; frame < 5; ++frame) {
        const Picture same = grey(0.3 + 0.1 * frame);
        scores.add(same, same, kLooking);
    }
    EXPECT_EQ(scores.total().back().instability, 0.0);
    EXPECT_EQ(scores.total().back().flicker_energy, 0.0);
}

TEST(Temporal, ATestThatLagsBehindIsTooStable) {
    TemporalScores scores;
    scores.add(grey(0.3), grey(0.3), kLooking);
    const auto frame = scores.add(grey(0.5), grey(0.4), kLooking);
    EXPECT_NEAR(frame.back().instability, -0.1, 1e-5);
}

// Columns of noise that move to the right by `shift` pixels.
Picture moved(double shift) {
    Picture picture{12, 9, {}};
    for (int y = 0; y < 9; ++y) {
        for (int x = 0; x < 12; ++x) {
            const double place = x - shift;
            const auto value = static_cast<float>(0.5 + 0.3 * std::sin(1.3 * place + 0.2 * y));
            picture.rgb.insert(picture.rgb.end(), {value, value, value});
        }
    }
    return picture;
}

TEST(Temporal, MotionIsCompensated) {
    const MotionField motion{12, 9, [] {
                                 std::vector<float> xy;
                                 for (int i = 0; i < 12 * 9; ++i)
                                     xy.insert(xy.end(), {-1.0f, 0.0f});
                                 return xy;
                             }()};
    TemporalScores with, without;
    for (int frame = 0; frame < 4; ++frame) {
        with.add(grey(0.5), moved(frame), kLooking, &motion);
        without.add(grey(0.5), moved(frame), kLooking);
    }
    // The leftmost column comes from outside.
    EXPECT_EQ(with.total().back().pixels, 3u * 11 * 9);
    EXPECT_NEAR(with.total().back().instability, 0.0, 1e-6);
    EXPECT_GT(without.total().back().instability, 0.1);
}

TEST(Temporal, PixelsWithoutMotionAreLeftOut) {
    MotionField motion{12, 9, std::vector<float>(2 * 12 * 9, 0.0f)};
    motion.xy[0] = 1e6f; // as the renderer writes it
    motion.xy[3] = std::nanf("");
    motion.xy[4] = -2.5f; // the column 2 - 2.5 = -0.5 is the picture's edge: still inside
    TemporalScores scores;
    scores.add(grey(0.5), grey(0.4), kLooking, &motion);
    const auto frame = scores.add(grey(0.5), grey(0.6), kLooking, &motion);
    EXPECT_EQ(frame.back().pixels, 12u * 9 - 2);
    EXPECT_NEAR(frame.back().instability, 0.2, 1e-5);
}

TEST(Temporal, DoesNotDependOnTheNumberOfThreads) {
    const ScalarMap looking(97, 83, 5.0f);
    const auto run = [&] {
        TemporalScores scores;
        for (unsigned frame = 0; frame < 3; ++frame)
            scores.add(noise(97, 83, frame), noise(97, 83, 10 + frame), looking);
        return scores.total().back().flicker_energy;
    };
    const double many = run();
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(run(), many);
}

TEST(Temporal, RefusesFramesThatDoNotFit) {
    TemporalScores scores;
    scores.add(grey(0.5), grey(0.5), kLooking);
    EXPECT_THROW(scores.add(grey(0.5, 9, 12), grey(0.5, 9, 12), ScalarMap(9, 12)),
                 std::invalid_argument);
    EXPECT_THROW(scores.add(grey(0.5), grey(0.5), ScalarMap(9, 12)), std::invalid_argument);
    const MotionField motion{9, 12, std::vector<float>(2 * 12 * 9)};
    EXPECT_THROW(scores.add(grey(0.5), grey(0.5), kLooking, &motion), std::invalid_argument);
}

} // namespace
} // namespace macula::metric
