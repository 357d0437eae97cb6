// The kernel log-polar transform (Mrad 2022, equations 2.2 and 2.3) and its inverse.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "lib/log_polar.h"

namespace {
using namespace macula::shared;

constexpr float kFar = 1101.0f; // half the diagonal of 1920 x 1080

LogPolarParams params(float alpha) {
    LogPolarParams p{};
    p.width = 1067;
    p.height = 600;
    p.alpha = alpha;
    p.inverse_alpha = 1.0f / alpha;
    return p;
}

Fovea fovea(float far) {
    Fovea f{};
    f.log_far = std::log2(far + 1.0f);
    f.inverse_log_far = 1.0f / f.log_far;
    return f;
}

class Kernel : public testing::TestWithParam<float> {};

TEST_P(Kernel, DistancesComeBackToWithinAFiftiethOfAPixel) {
    const LogPolarParams p = params(GetParam());
    for (const float far : {3.0f, 100.0f, kFar, 9000.0f}) {
        const Fovea f = fovea(far);
        for (int step = 0; step <= 2000; ++step) {
            const float distance = far * float(step) / 2000.0f;
            const float column = log_polar_column(&p, &f, distance);
            ASSERT_GE(column, 0.0f);
            ASSERT_LE(column, 1067.001f);
            // Rounding grows with the distance: 9000 pixels are known to a thousandth.
            EXPECT_NEAR(log_polar_distance(&p, &f, column), distance,
                        0.02f + distance * 2e-6f * GetParam())
                << "of " << far;
        }
    }
}

TEST_P(Kernel, TheGazeItselfAndTheFurthestCornerAreTheFirstAndTheLastColumn) {
    const LogPolarParams p = params(GetParam());
    const Fovea f = fovea(kFar);
    EXPECT_EQ(log_polar_column(&p, &f, 0.0f), 0.0f);
    EXPECT_EQ(log_polar_distance(&p, &f, 0.0f), 0.0f);
    EXPECT_NEAR(log_polar_column(&p, &f, kFar), 1067.0f, 1e-3f);
    EXPECT_NEAR(log_polar_distance(&p, &f, 1067.0f), kFar, 0.02f);
    EXPECT_EQ(log_polar_column(&p, &f, 2.0f * kFar), 1067.0f) << "beyond the corner";
}

TEST_P(Kernel, ATexelIsAsLongAsTheDistanceGrows) {
    const LogPolarParams p = params(GetParam());
    const Fovea f = fovea(kFar);
    for (float column = 700.0f; column < 1066.0f; column += 13.0f) {
        const double along = double{log_polar_distance(&p, &f, column + 0.5f)} -
                             log_polar_distance(&p, &f, column - 0.5f);
        const float distance = log_polar_distance(&p, &f, column);
        const TexelSize size = log_polar_texel(&p, &f, column, distance);
        EXPECT_NEAR(size.along, along, 0.01 * along);
        EXPECT_NEAR(size.around, 2.0 * std::numbers::pi * distance / 600.0, 1e-4);
    }
}

INSTANTIATE_TEST_SUITE_P(Alphas, Kernel, testing::Values(1.0f, 2.0f, 4.0f, 7.5f));

TEST(Rows, GoOnceAroundAndComeBack) {
    const LogPolarParams p = params(4.0f);
    float before = -1.0f;
    for (int step = 0; step < 1000; ++step) {
        const double turn = 2.0 * std::numbers::pi * (step + 0.5) / 1000.0;
        const float x = float(50.0 * std::cos(turn)), y = float(50.0 * std::sin(turn));
        const float row = log_polar_row(&p, x, y);
        EXPECT_GT(row, before);
        EXPECT_NEAR(row, 0.6 * (step + 0.5), 1e-3);
        float cosine;
        const float sine = log_polar_direction(&p, row, &cosine);
        EXPECT_NEAR(50.0f * cosine, x, 1e-3f);
        EXPECT_NEAR(50.0f * sine, y, 1e-3f);
        before = row;
    }
    EXPECT_EQ(log_polar_row(&p, 0.0f, 0.0f), 0.0f);
}

// Both directions at once, in the image's coordinates: the gaze's own pixel, one at a pixel's edge,
// a corner, and gazes outside of the image. The bound is a fiftieth of a pixel and what rounding
// takes of the distance.
TEST_P(Kernel, PointsOfTheImageComeBackWhereverTheGazeIs) {
    const LogPolarParams p = params(GetParam());
    for (const auto& [gaze_x, gaze_y] : {std::pair{960.5f, 540.5f},
                                         {960.0f, 540.0f},
                                         {0.0f, 1080.0f},
                                         {-400.0f, 300.0f},
                                         {2400.0f, -500.0f}}) {
        const Fovea f = fovea(
            std::hypot(std::max(gaze_x, 1920.0f - gaze_x), std::max(gaze_y, 1080.0f - gaze_y)));
        for (int j = 0; j < 1080; j += 9)
            for (int i = 0; i < 1920; i += 8) {
                const float x = float(i) + 0.5f, y = float(j) + 0.5f;
                const float dx = x - gaze_x, dy = y - gaze_y, distance = std::hypot(dx, dy);
                const float column = log_polar_column(&p, &f, distance);
                float cosine;
                const float sine = log_polar_direction(&p, log_polar_row(&p, dx, dy), &cosine);
                const float back = log_polar_distance(&p, &f, column);
                const float bound = 0.02f + distance * 2e-6f * (GetParam() + 1.0f);
                ASSERT_NEAR(gaze_x + back * cosine, x, bound) << gaze_x << ", " << gaze_y;
                ASSERT_NEAR(gaze_y + back * sine, y, bound) << x << ", " << y;
            }
    }
}

} // namespace
