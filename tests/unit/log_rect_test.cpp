// The log-rectilinear transform of one axis (Li et al. 2021) and its inverse.
#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

#include "lib/log_rect.h"

namespace {
using namespace macula::shared;

// Alpha, texels for 1920 pixels.
class Axis : public testing::TestWithParam<std::tuple<float, unsigned>> {
  protected:
    float alpha = std::get<0>(GetParam());
    unsigned texels = std::get<1>(GetParam());
};

constexpr float kGazes[] = {960.0f, 0.0f, 1920.0f, 3.7f, 1500.25f, -400.0f, 5000.0f};

TEST_P(Axis, PlacesComeBackToWithinATenthOfAPixel) {
    for (const float gaze : kGazes) {
        const RectAxis axis = make_rect_axis(gaze, 1920, texels);
        for (float place = 0.0f; place <= 1920.0f; place += 0.37f) {
            const float texel = rect_texel(&axis, 1.0f / alpha, place);
            EXPECT_NEAR(rect_place(&axis, alpha, texel).place, place, 0.1f) << "gaze " << gaze;
        }
    }
}

TEST_P(Axis, GoesFromTheImagesFirstEdgeToItsLast) {
    for (const float gaze : kGazes) {
        const RectAxis axis = make_rect_axis(gaze, 1920, texels);
        EXPECT_NEAR(rect_texel(&axis, 1.0f / alpha, 0.0f), 0.0f, 2e-3f) << "gaze " << gaze;
        EXPECT_NEAR(rect_texel(&axis, 1.0f / alpha, 1920.0f), float(texels), 2e-3f);
        EXPECT_NEAR(rect_place(&axis, alpha, 0.0f).place, 0.0f, 1e-3f);
        EXPECT_NEAR(rect_place(&axis, alpha, float(texels)).place, 1920.0f, 1e-3f);
        EXPECT_NEAR(rect_place(&axis, alpha, -5.0f).place, 0.0f, 1e-3f) << "before the buffer";
        EXPECT_NEAR(rect_place(&axis, alpha, float(texels + 5)).place, 1920.0f, 1e-3f);
    }
}

TEST_P(Axis, ATexelsSizeIsHowFarItsEdgesAreApart) {
    const RectAxis axis = make_rect_axis(700.5f, 1920, texels);
    int compared = 0;
    for (unsigned texel = 1; texel + 1 < texels; ++texel) {
        const RectPlace p = rect_place(&axis, alpha, float(texel) + 0.5f);
        const RectPlace first = rect_place(&axis, alpha, float(texel));
        const RectPlace last = rect_place(&axis, alpha, float(texel + 1));
        // Of one kind from edge to edge, and not around the gaze.
        const bool warped = first.size > 1.0f && p.size > 1.0f && last.size > 1.0f;
        const bool even = first.size == 1.0f && p.size == 1.0f && last.size == 1.0f;
        if ((!warped && !even) || std::fabs(float(texel) + 0.5f - axis.middle) < 1.0f)
            continue;
        EXPECT_NEAR(p.size, last.place - first.place, 0.03f * p.size + 0.01f) << texel;
        ++compared;
    }
    EXPECT_GT(compared, int(texels * 9 / 10));
}

// Rises, and never puts two texels into one pixel.
TEST_P(Axis, ATexelIsAtLeastAPixel) {
    for (const float gaze : kGazes) {
        const RectAxis axis = make_rect_axis(gaze, 1920, texels);
        for (unsigned texel = 0; texel + 1 < texels; ++texel) {
            const float a = rect_place(&axis, alpha, float(texel)).place;
            const float b = rect_place(&axis, alpha, float(texel + 1)).place;
            EXPECT_GT(b - a, 0.99f) << "gaze " << gaze << ", texel " << texel;
        }
    }
}

TEST_P(Axis, TheGazesOwnTexelsLieOverPixels) {
    if (alpha < 2.0f || texels < 400)
        return; // a texel there is more than a pixel from the start
    for (const float gaze : {960.0f, 1500.25f, 700.5f}) {
        const RectAxis axis = make_rect_axis(gaze, 1920, texels);
        for (int k = -8; k <= 8; ++k) {
            const float place = std::floor(gaze) + 0.5f + float(k);
            const float texel = rect_texel(&axis, 1.0f / alpha, place);
            EXPECT_NEAR(texel - std::floor(texel), 0.5f, 1e-3f) << "gaze " << gaze;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Shapes, Axis,
                         testing::Combine(testing::Values(1.0f, 2.0f, 4.0f),
                                          testing::Values(1067u, 480u, 120u, 1920u)));

TEST(AxisOfOneTexelAPixel, IsTheIdentity) {
    for (const float gaze : kGazes) {
        const RectAxis axis = make_rect_axis(gaze, 1920, 1920);
        for (float place = 0.0f; place <= 1920.0f; place += 7.3f)
            EXPECT_NEAR(rect_texel(&axis, 0.25f, place), place, 2e-4f);
    }
}

TEST(AxisOfFewTexels, IsWhole) {
    for (const float gaze : {0.0f, 1.3f, 2.5f, 4.0f, 5.0f}) {
        const RectAxis axis = make_rect_axis(gaze, 5, 4);
        EXPECT_NEAR(rect_place(&axis, 4.0f, 0.0f).place, 0.0f, 1e-5f);
        EXPECT_NEAR(rect_place(&axis, 4.0f, 4.0f).place, 5.0f, 1e-5f);
    }
}

} // namespace
