// The order of the primary rays, and the camera in both directions.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "host/frame/frame_params.hpp"
#include "lib/camera.h"

namespace {
using namespace macula;
using shared::float3;

struct Size {
    std::uint32_t width, height;
};

class RayOrder : public testing::TestWithParam<Size> {};

TEST_P(RayOrder, VisitsEveryPixelExactlyOnce) {
    const auto [width, height] = GetParam();
    std::vector<int> visits(std::size_t{width} * height, 0);
    for (std::uint32_t slot = 0; slot < shared::slot_count(width, height); ++slot) {
        std::uint32_t x = 0, y = 0;
        shared::pixel_of_slot(slot, width, &x, &y);
        if (x < width && y < height) {
            ++visits[std::size_t{y} * width + x];
            EXPECT_EQ(shared::slot_of_pixel(x, y, width), slot);
        }
    }
    EXPECT_TRUE(std::all_of(visits.begin(), visits.end(), [](int n) { return n == 1; }));
}

INSTANTIATE_TEST_SUITE_P(Sizes, RayOrder,
                         testing::Values(Size{1, 1}, Size{32, 32}, Size{33, 31}, Size{640, 480},
                                         Size{1182, 1464}, Size{3, 200}, Size{200, 3}));

TEST(RayOrderPackets, SixteenNeighboursAreOneSquareOfFourPixels) {
    for (std::uint32_t slot = 0; slot < shared::slot_count(70, 70); slot += 16) {
        std::uint32_t x0 = 0, y0 = 0;
        shared::pixel_of_slot(slot, 70, &x0, &y0);
        EXPECT_EQ(x0 % 4, 0u);
        EXPECT_EQ(y0 % 4, 0u);
        for (std::uint32_t lane = 0; lane < 16; ++lane) {
            std::uint32_t x = 0, y = 0;
            shared::pixel_of_slot(slot + lane, 70, &x, &y);
            EXPECT_EQ(x, x0 + lane % 4);
            EXPECT_EQ(y, y0 + lane / 4);
        }
    }
}

TEST(RayOrderPackets, SixteenPacketsInARowCoverASquare) {
    std::uint32_t least_x = 99, most_x = 0, least_y = 99, most_y = 0;
    for (std::uint32_t slot = 256; slot < 512; ++slot) {
        std::uint32_t x = 0, y = 0;
        shared::pixel_of_slot(slot, 64, &x, &y);
        least_x = std::min(least_x, x);
        most_x = std::max(most_x, x);
        least_y = std::min(least_y, y);
        most_y = std::max(most_y, y);
    }
    EXPECT_EQ(most_x - least_x, 15u);
    EXPECT_EQ(most_y - least_y, 15u);
}

shared::Camera test_camera(const frame::Tangents& tangents) {
    scene::Camera view;
    view.eye = {3.0f, -2.0f, 7.0f};
    view.target = {-1.0f, 4.0f, 1.5f};
    return frame::make_camera(view, tangents);
}

TEST(Camera, AxesAreOrthonormalAndRightHanded) {
    const shared::Camera c = test_camera({1, 1, 1, 1});
    const auto dot = [](const float* a, const float* b) {
        return double{a[0]} * b[0] + double{a[1]} * b[1] + double{a[2]} * b[2];
    };
    EXPECT_NEAR(dot(c.right, c.right), 1.0, 1e-6);
    EXPECT_NEAR(dot(c.up, c.up), 1.0, 1e-6);
    EXPECT_NEAR(dot(c.forward, c.forward), 1.0, 1e-6);
    EXPECT_NEAR(dot(c.right, c.up), 0.0, 1e-6);
    EXPECT_NEAR(dot(c.right, c.forward), 0.0, 1e-6);
    // right x up = backwards
    EXPECT_NEAR(c.right[0] * c.up[1] - c.right[1] * c.up[0], -c.forward[2], 1e-6);
    EXPECT_GT(c.up[1], 0.0f);
}

TEST(Camera, CornersLieAtTheTangentsOfAnAsymmetricDisplay) {
    const frame::Tangents dk2{1.0586f, 1.0924f, 1.3299f, 1.3299f};
    scene::Camera view;
    view.eye = {0, 0, 0};
    view.target = {0, 0, -1};
    const shared::Camera c = frame::make_camera(view, dk2);
    const float3 upper_left = shared::camera_direction(&c, 1182, 1464, 0.0f, 0.0f);
    EXPECT_NEAR(upper_left.x, -1.0586f, 1e-6);
    EXPECT_NEAR(upper_left.y, 1.3299f, 1e-6);
    EXPECT_EQ(upper_left.z, -1.0f);
    const float3 lower_right = shared::camera_direction(&c, 1182, 1464, 1182.0f, 1464.0f);
    EXPECT_NEAR(lower_right.x, 1.0924f, 1e-6);
    EXPECT_NEAR(lower_right.y, -1.3299f, 1e-6);
}

TEST(Camera, ProjectionInvertsDirection) {
    const shared::Camera c = test_camera({0.7f, 1.1f, 0.5f, 0.9f});
    for (float x = 0.25f; x < 300.0f; x += 37.0f)
        for (float y = 0.75f; y < 200.0f; y += 23.0f)
            for (const float t : {0.01f, 1.0f, 5000.0f}) {
                const float3 view = shared::camera_direction(&c, 300, 200, x, y) * t;
                float px = 0, py = 0;
                ASSERT_TRUE(shared::camera_project(&c, 300, 200, view, &px, &py));
                EXPECT_NEAR(px, x, 2e-3);
                EXPECT_NEAR(py, y, 2e-3);
            }
}

TEST(Camera, DoesNotProjectWhatLiesBehind) {
    const shared::Camera c = test_camera({1, 1, 1, 1});
    float x = 0, y = 0;
    const float3 back = -shared::vector_at(c.forward);
    EXPECT_FALSE(shared::camera_project(&c, 10, 10, back, &x, &y));
    EXPECT_FALSE(shared::camera_project(&c, 10, 10, {0, 0, 0}, &x, &y));
}

TEST(Camera, VerticalFieldOfViewBecomesItsTangent) {
    for (const float fov : {1.0f, 39.3077f, 60.0f, 90.0f, 170.0f}) {
        const frame::Tangents t = frame::tangents_of(fov, 200, 100);
        const double angle = double{fov} * std::numbers::pi / 360.0;
        const double expected = std::tan(angle);
        // A rounded angle changes its tangent by angle / (sin cos) times as much, relatively.
        const double tolerance =
            1.2e-7 * expected * (2.0 + angle / (std::sin(angle) * std::cos(angle)));
        EXPECT_NEAR(t.up, expected, tolerance);
        EXPECT_NEAR(t.right, 2.0 * expected, 2.0 * tolerance);
    }
    EXPECT_THROW(frame::tangents_of(180.0f, 1, 1), std::invalid_argument);
    EXPECT_THROW(frame::tangents_of(std::nanf(""), 1, 1), std::invalid_argument);
}

TEST(Camera, LookingStraightUpIsNoError) {
    scene::Camera view;
    view.eye = {0, 0, 0};
    view.target = {0, 5, 0};
    const shared::Camera c = frame::make_camera(view, {1, 1, 1, 1});
    EXPECT_NEAR(c.right[0] * c.right[0] + c.right[1] * c.right[1] + c.right[2] * c.right[2], 1.0f,
                1e-6f);
}

TEST(Camera, LookingAtItsOwnPositionIsAnError) {
    scene::Camera view;
    view.target = view.eye;
    EXPECT_THROW(frame::make_camera(view, {1, 1, 1, 1}), std::invalid_argument);
    view.target.x = std::nanf("");
    EXPECT_THROW(frame::make_camera(view, {1, 1, 1, 1}), std::invalid_argument);
}

TEST(Subpixel, SquareNumbersGiveARegularGrid) {
    float x = 0, y = 0;
    shared::subpixel_offset(0, 0, 1, &x, &y);
    EXPECT_EQ(x, 0.5f);
    EXPECT_EQ(y, 0.5f);
    std::vector<std::pair<float, float>> offsets;
    for (std::uint32_t i = 0; i < 4; ++i) {
        shared::subpixel_offset(0, i, 2, &x, &y);
        offsets.emplace_back(x, y);
    }
    const std::vector<std::pair<float, float>> expected{
        {0.25f, 0.25f}, {0.75f, 0.25f}, {0.25f, 0.75f}, {0.75f, 0.75f}};
    EXPECT_EQ(offsets, expected);
}

TEST(Subpixel, OtherNumbersGiveHashedOffsetsInsideThePixel) {
    for (std::uint32_t i = 0; i < 1000; ++i) {
        float x = -1, y = -1;
        shared::subpixel_offset(shared::random_key(i, 3, 4), i % 5, 0, &x, &y);
        EXPECT_TRUE(x >= 0.0f && x < 1.0f && y >= 0.0f && y < 1.0f);
    }
}

TEST(FrameSettings, OutOfRangeIsAnErrorThatNamesTheSetting) {
    frame::FrameSettings settings;
    settings.width = 0;
    EXPECT_THROW(frame::check(settings), std::invalid_argument);
    settings = {};
    settings.samples_per_pixel = 0;
    EXPECT_THROW(frame::check(settings), std::invalid_argument);
    settings = {};
    settings.ambient_occlusion_samples = 16;
    settings.ambient_occlusion_radius = std::nanf("");
    EXPECT_THROW(frame::check(settings), std::invalid_argument);
}

} // namespace
