#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "scenes/camera_path.hpp"

namespace macula::scene {
namespace {

CameraPath path_of(std::initializer_list<std::pair<float, float>> keys) {
    CameraPath path;
    for (const auto& [frame, x] : keys)
        path.keys.push_back({frame, {x, 2.0f * x, 0.0f}, {0.0f, x, 1.0f}});
    return path;
}

TEST(CameraPath, PassesThroughItsKeysExactly) {
    const CameraPath path = path_of({{0, 0.1f}, {10, 3.7f}, {35, -2.3f}, {40, 0.9f}});
    for (const CameraKey& key : path.keys) {
        EXPECT_EQ(view_at(path, key.frame).eye, key.eye);
        EXPECT_EQ(view_at(path, key.frame).target, key.target);
    }
}

TEST(CameraPath, OneKeyStandsStill) {
    const CameraPath path = path_of({{5, 1.5f}});
    for (const float frame : {-10.0f, 0.0f, 5.0f, 6.0f, 1e30f})
        EXPECT_EQ(view_at(path, frame).eye, path.keys[0].eye);
}

TEST(CameraPath, IsClampedToItsEndsAndNanIsTheStart) {
    const CameraPath path = path_of({{10, 1.0f}, {20, 2.0f}});
    EXPECT_EQ(view_at(path, 0.0f).eye.x, 1.0f);
    EXPECT_EQ(view_at(path, 1000.0f).eye.x, 2.0f);
    EXPECT_EQ(view_at(path, std::numeric_limits<float>::quiet_NaN()).eye.x, 1.0f);
}

TEST(CameraPath, EvenSpeedStaysEvenOverUnevenKeys) {
    const CameraPath path = path_of({{0, 0}, {10, 10}, {15, 15}, {40, 40}, {60, 60}});
    for (int i = 20; i <= 80; ++i) {
        const float frame = 0.5f * static_cast<float>(i);
        EXPECT_NEAR(view_at(path, frame).eye.x, frame, 1e-4f) << frame;
    }
}

TEST(CameraPath, HasNoJumpInSpeedAtKeys) {
    const CameraPath path = path_of({{0, 0}, {10, 3}, {15, 9}, {40, 4}, {60, 6}});
    constexpr float kStep = 0.01f;
    for (const float key : {10.0f, 15.0f, 40.0f}) {
        const float before = view_at(path, key).eye.x - view_at(path, key - kStep).eye.x;
        const float after = view_at(path, key + kStep).eye.x - view_at(path, key).eye.x;
        EXPECT_NEAR(before, after, 2e-4f) << key;
    }
}

TEST(CameraPath, NoKeysAreAnError) {
    EXPECT_THROW(view_at(CameraPath{}, 0.0f), std::invalid_argument);
}

} // namespace
} // namespace macula::scene
