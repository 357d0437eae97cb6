// Histories beyond the foveal disk, where a sample stands for many pixels: what they must not be
// taken from, and where they must not be lost.
#include <gtest/gtest.h>

#include "tests/support/upscale_pictures.hpp"

namespace {
using namespace macula;
using namespace macula::test;
using namespace macula::test::upscale;

constexpr int kWidth = 200, kHeight = 160;
constexpr int kReach = 10; // pixels: what two texels reach, as large as they are here

// From so far away that all of the box has one depth.
scene::Scene far_box() {
    return two_sided_box(-6.0f, 4.0f, {{0.8f, 0, 80}, {0.8f, 0, 0}, 2.0f});
}

bool shows(const Picture& picture, int x, int y, int reach, bool red) {
    return shows(picture, kWidth, kHeight, x, y, reach, red, 0.001f);
}

WeierSetup tiny_disk(const char* method) {
    WeierSetup setup = of_method(method);
    setup.width = kWidth;
    setup.height = kHeight;
    setup.temporal.ratio = 1.0f;
    setup.log_polar.disk = 0.05f;
    setup.log_polar.alpha = 1.5f;
    setup.geometry.merge_static = false;
    setup.outputs = {"followed motion"};
    return setup;
}

class BeyondTheDisk : public testing::TestWithParam<const char*> {};

TEST_P(BeyondTheDisk, ASideThatTurnsUpTakesNoHistoryFromTheOneBesideIt) {
    const scene::Scene scene = far_box();
    WeierFrames frames(device(), scene, tiny_disk(GetParam()));
    Picture before;
    int turned_up = 0, kept = 0, followed = 0;
    for (std::uint32_t frame = 0; frame < 8; ++frame) {
        frames.place(std::vector{scene::Transform{}, turned(frame % 2 == 0 ? -0.15f : 0.2f)});
        frames.run(frame, scene.cameras.front());
        const Picture now = frames.read<Float4>("colour");
        const auto motion = frames.read<float>("followed motion");
        for (int y = 0; frame > 0 && y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const auto i = std::size_t(y * kWidth + x);
                const bool has_history = std::abs(motion[i]) < 1000.0f;
                followed += has_history ? 1 : 0;
                if (!shows(now, x, y, kReach, false))
                    continue;
                const int from = x + int(std::lround(motion[i]));
                kept += has_history && shows(before, from, y, kReach, true) ? 1 : 0;
                turned_up += has_history ? 0 : 1;
            }
        before = now;
    }
    EXPECT_GT(turned_up, 100);
    EXPECT_EQ(kept, 0);
    EXPECT_GT(followed, 7 * kWidth * kHeight / 2);
}

// Slanted ridges as wide as a pixel, whose sides face left and right: what a texel hits the jitter
// decides.
scene::Scene ridges() {
    scene::Mesh mesh;
    for (int i = -180; i < 180; ++i) {
        const float x = 0.014f * float(i);
        add_quad(mesh, {x - 0.75f, -2, 0}, {0.007f, 0, 0.007f}, {1.5f, 4, 0});
        add_quad(mesh, {x - 0.743f, -2, 0.007f}, {0.007f, 0, -0.007f}, {1.5f, 4, 0});
    }
    return scene_of(std::move(mesh), {{0, 0, 80}, {0, 0, 0}, 2.0f});
}

TEST_P(BeyondTheDisk, FinePatternsOfFacesKeepTheirHistory) {
    const scene::Scene scene = ridges();
    for (const float step : {0.0f, 0.02f}) {
        WeierFrames frames(device(), scene, tiny_disk(GetParam()));
        int lost = 0, all = 0;
        for (std::uint32_t frame = 0; frame < 12; ++frame) {
            frames.run(frame, moved(scene, {0.0f, step * float(frame), 0.0f}));
            const auto motion = frames.read<float>("followed motion");
            for (int i = 4 * kWidth; frame > 0 && i < (kHeight - 4) * kWidth; ++i) {
                lost += std::abs(motion[std::size_t(i)]) > 1000.0f ? 1 : 0;
                ++all;
            }
        }
        // Beside the disk three texels fit into a side of a ridge.
        if (step == 0.0f)
            EXPECT_EQ(lost, 0);
        else
            EXPECT_LT(double(lost), 0.02 * double(all));
    }
}

// Boards that stand before a wall, striped so that histories are worth having.
scene::Scene standing_boards() {
    scene::Mesh mesh;
    add_quad(mesh, {-40, -40, -20}, {80, 0, 0}, {0, 80, 0});
    for (int i = -6; i < 6; ++i)
        add_quad(mesh, {float(i), -3, -8}, {0.5f, 0, 0}, {0, 6, 0});
    return scene_of(std::move(mesh), {{0, 0, 0}, {0, 0, -1}, 60.0f});
}

TEST_P(BeyondTheDisk, EdgesOfWhatStandsStillKeepTheirHistory) {
    const scene::Scene scene = standing_boards();
    WeierFrames frames(device(), scene, tiny_disk(GetParam()));
    int lost = 0, all = 0;
    for (std::uint32_t frame = 0; frame < 12; ++frame) {
        // The boards pass by 0.7 pixels a frame and before the wall 0.4 pixels.
        frames.run(frame, moved(scene, {0.04f * float(frame), 0.0f, 0.0f}));
        const auto motion = frames.read<float>("followed motion");
        for (int y = 0; frame > 0 && y < kHeight; ++y)
            for (int x = 4; x < kWidth - 4; ++x) {
                lost += std::abs(motion[std::size_t(y * kWidth + x)]) > 1000.0f ? 1 : 0;
                ++all;
            }
    }
    EXPECT_LT(double(lost), 0.005 * double(all));
}

TEST_P(BeyondTheDisk, WhatMovesHasTheSameBitsInOneAndSixteenLanes) {
    const scene::Scene scene = scene::load("whitted_moving");
    std::vector<std::string> hashes;
    for (const std::uint32_t lanes : {1u, 16u}) {
        render::Options options;
        options.width = 150;
        options.height = 90;
        options.method = GetParam();
        options.lanes = lanes;
        options.log_polar.alpha = 1.5f;
        render::Renderer renderer(device(), scene, options);
        for (std::uint32_t frame = 30; frame < 34; ++frame)
            renderer.render(frame);
        hashes.push_back(renderer.hash());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

INSTANTIATE_TEST_SUITE_P(Modes, BeyondTheDisk,
                         testing::Values("logpolar+taa", "logpolar+taa+upscale", "logrect+taa"),
                         [](const auto& mode) {
                             std::string name = mode.param;
                             std::replace(name.begin(), name.end(), '+', '_');
                             return name;
                         });

} // namespace
