// Every mode that gathers samples over frames: what no history may show.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/upscale_pictures.hpp"

namespace {
using namespace macula;
using namespace macula::test;
using namespace macula::test::upscale;

// A red board in front of a blue wall.
scene::Scene board_and_wall() {
    scene::Mesh wall, board;
    add_quad(wall, {-40, -40, -20}, {80, 0, 0}, {0, 80, 0}, 0);
    add_quad(board, {-1, -1, -4}, {2, 0, 0}, {0, 2, 0}, 1);
    scene::Scene scene = scene_of(std::move(wall), {{0, 0, 0}, {0, 0, -1}, 70.0f});
    scene.meshes.push_back(std::move(board));
    scene.instances.push_back({1, {}, "board"});
    scene.materials.resize(2);
    scene.materials[0].diffuse = scene.materials[1].diffuse = glm::vec3(0.0f);
    scene.materials[0].emission = glm::vec3(0.0f, 0.0f, 0.5f);
    scene.materials[1].emission = glm::vec3(1.0f, 0.0f, 0.0f);
    return scene;
}

// Pixels two or more away from the board, in the frame's own truth, that show some of it.
std::size_t stale_pixels(const Picture& ours, const Picture& truth, int width, int height,
                         int reach) {
    std::size_t wrong = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            bool wall = true;
            for (int j = -reach; j <= reach; ++j)
                for (int i = -reach; i <= reach; ++i) {
                    const int column = std::clamp(x + i, 0, width - 1);
                    const int row = std::clamp(y + j, 0, height - 1);
                    wall = wall && truth[std::size_t(row * width + column)].x < 0.5f;
                }
            wrong += wall && ours[std::size_t(y * width + x)].x > 0.02f ? 1 : 0;
        }
    return wrong;
}

class EachMode : public testing::TestWithParam<const char*> {};

TEST_P(EachMode, UncoveredPixelsNeverShowHistory) {
    const scene::Scene scene = board_and_wall();
    WeierSetup setup = whole_disk(GetParam());
    setup.width = 220;
    setup.height = 180;
    WeierFrames ours(device(), scene, setup);
    setup.method = "full";
    WeierFrames full(device(), scene, setup);
    for (std::uint32_t frame = 0; frame < 10; ++frame) {
        const scene::Camera view = moved(scene, {0.1f * float(frame), 0.0f, 0.0f});
        ours.run(frame, view);
        full.run(frame, view);
        EXPECT_EQ(stale_pixels(ours.read<Float4>(ours.picture()), full.read<Float4>("colour"), 220,
                               180, 3),
                  0u)
            << "frame " << frame;
    }
}

// Not by its colour, which clipping may put right, but by the motion: what the board hid has none.
TEST_P(EachMode, UncoveredPixelsAreNotFollowed) {
    const scene::Scene scene = board_and_wall();
    WeierSetup setup = whole_disk(GetParam());
    setup.width = 150;
    setup.height = 120;
    setup.temporal.ratio = 1.0f;
    setup.outputs = {"followed motion"};
    WeierFrames frames(device(), scene, setup);
    std::vector<bool> board, before;
    int uncovered = 0, kept = 0, followed = 0;
    for (std::uint32_t frame = 0; frame < 6; ++frame) {
        const float eye = frame % 2 == 0 ? -0.2f : 0.2f;
        frames.run(frame, moved(scene, {eye, 0, 0}));
        const auto motion = frames.read<float>("followed motion");
        before.swap(board);
        board.clear();
        for (const Float4& c : frames.read<Float4>("colour"))
            board.push_back(c.x > 0.0f);
        // The wall is 20 away, 120 pixels are seen at an angle of 70 degrees.
        const float apart = frame % 2 == 0 ? -0.4f : 0.4f;
        const float shift = apart * 60.0f / (20.0f * std::tan(35.0f * 0.0174533f));
        for (int y = 2; frame > 0 && y < 118; ++y)
            for (int x = 2; x < 148; ++x) {
                const auto near = [&](const std::vector<bool>& all, int at, bool wanted) {
                    bool same = at >= 1 && at < 149;
                    for (int i = -1; same && i <= 1; ++i)
                        for (int j = -1; j <= 1; ++j)
                            same = same && all[std::size_t((y + j) * 150 + at + i)] == wanted;
                    return same;
                };
                const bool is_kept = std::abs(motion[std::size_t(y * 150 + x)]) < 100.0f;
                followed += is_kept ? 1 : 0;
                const bool hidden =
                    near(board, x, false) && near(before, x + int(std::lround(shift)), true);
                uncovered += hidden ? 1 : 0;
                kept += hidden && is_kept ? 1 : 0;
            }
    }
    EXPECT_GT(uncovered, 200);
    EXPECT_EQ(kept, 0);
    EXPECT_GT(followed, 3 * 150 * 120);
}

TEST_P(EachMode, WhatMovesLeavesNoTrail) {
    const scene::Scene scene = board_and_wall();
    WeierSetup setup = whole_disk(GetParam());
    setup.width = 220;
    setup.height = 180;
    setup.geometry.merge_static = false;
    WeierFrames ours(device(), scene, setup);
    setup.method = "full";
    WeierFrames full(device(), scene, setup);
    for (std::uint32_t frame = 0; frame < 8; ++frame) {
        scene::Transform there;
        there.row[0].w = 0.07f * float(frame);
        for (WeierFrames* frames : {&ours, &full}) {
            frames->place(std::vector{scene::Transform{}, there});
            frames->run(frame, scene.cameras.front());
        }
        EXPECT_EQ(stale_pixels(ours.read<Float4>(ours.picture()), full.read<Float4>("colour"), 220,
                               180, 3),
                  0u)
            << "frame " << frame;
    }
}

TEST(BeyondTheDisk, AnEdgeThatMovesStaysWhereItIs) {
    const scene::Scene scene = board_and_wall();
    // With one motion for both sides of the edge it is 1.04 and 1.23 of a single frame's error.
    using Limit = std::pair<const char*, double>;
    for (const auto& [method, most] : {Limit("logpolar+taa", 0.97), Limit("logrect+taa", 1.1)}) {
        WeierSetup setup = of_method(method);
        setup.width = 220;
        setup.height = 180;
        setup.log_polar.disk = 0.05f;
        WeierFrames ours(device(), scene, setup);
        setup.method = "full";
        WeierFrames full(device(), scene, setup);
        double smoothed = 0.0, single = 0.0;
        for (std::uint32_t frame = 0; frame < 16; ++frame) {
            const scene::Camera view = moved(scene, {0.05f * float(frame), 0.0f, 0.0f});
            ours.run(frame, view);
            full.run(frame, view);
            if (frame < 8)
                continue;
            const Picture truth = full.read<Float4>("colour");
            smoothed += mean_error(ours.read<Float4>("stable colour"), truth);
            single += mean_error(ours.read<Float4>("colour"), truth);
        }
        EXPECT_LT(smoothed, most * single) << method;
    }
}

TEST(BeyondTheDisk, NothingIsDarkerBesideALamp) {
    scene::Scene scene = board_and_wall();
    scene.materials[0].emission = glm::vec3(0.3f);
    scene.materials[1].emission = glm::vec3(20.0f);
    WeierSetup setup = of_method("logpolar+taa+upscale");
    setup.log_polar.disk = 0.01f;
    WeierFrames frames(device(), scene, setup);
    for (std::uint32_t frame = 0; frame < 20; ++frame)
        frames.run(frame, scene.cameras.front());
    float least = 1.0f;
    for (const Float4& pixel : frames.read<Float4>(frames.picture()))
        least = std::min(least, pixel.x);
    EXPECT_GT(least, 0.299f);
}

TEST_P(EachMode, ASideThatTurnsUpTakesNoHistoryFromTheOneBesideIt) {
    const scene::Scene scene = two_sided_box(-20.0f, 0.6f, {{1, 0, 6}, {1, 0, 0}, 20.0f});
    WeierSetup setup = whole_disk(GetParam());
    setup.width = 150;
    setup.height = 120;
    setup.temporal.ratio = 1.0f;
    setup.geometry.merge_static = false;
    setup.outputs = {"followed motion"};
    WeierFrames frames(device(), scene, setup);
    Picture before;
    int turned_up = 0, kept = 0, followed = 0;
    for (std::uint32_t frame = 0; frame < 6; ++frame) {
        const float angle = frame % 2 == 0 ? -0.15f : 0.2f;
        frames.place(std::vector{scene::Transform{}, turned(angle)});
        frames.run(frame, scene.cameras.front());
        const Picture now = frames.read<Float4>("colour");
        const auto motion = frames.read<float>("followed motion");
        for (int y = 0; frame > 0 && y < 120; ++y)
            for (int x = 0; x < 150; ++x) {
                const auto i = std::size_t(y * 150 + x);
                followed += std::abs(motion[i]) < 100.0f ? 1 : 0;
                // It was behind the edge, where the front was in sight.
                if (!shows(now, 150, 120, x, y, 2, false, 0.0f))
                    continue;
                const int from = x + int(std::lround(motion[i]));
                const bool is_kept = std::abs(motion[i]) < 100.0f;
                kept += is_kept && shows(before, 150, 120, from, y, 1, true, 0.0f) ? 1 : 0;
                turned_up += is_kept ? 0 : 1;
            }
        before = now;
    }
    EXPECT_GT(turned_up, 100);
    EXPECT_EQ(kept, 0);
    EXPECT_GT(followed, 2 * 150 * 120);
}

// Squares of 0 and 1, about as large as the pixels that are rendered.
scene::Scene checkerboard() {
    scene::Mesh mesh;
    for (int j = -30; j < 30; ++j)
        for (int i = -30; i < 30; ++i)
            add_quad(mesh, {0.2f * float(i), 0.2f * float(j), -4}, {0.2f, 0, 0}, {0, 0.2f, 0},
                     (i + j) & 1);
    const std::vector<std::uint32_t> materials = mesh.triangle_material;
    mesh.triangle_material.assign(materials.size(), 0);
    scene::Scene scene = scene_of(std::move(mesh), {{0.03f, 0.05f, 0}, {0, 0, -1}, 70.0f});
    scene.materials.resize(2);
    scene.meshes[0].triangle_material = materials;
    scene.materials[0].diffuse = scene.materials[1].diffuse = glm::vec3(0.0f);
    scene.materials[1].emission = glm::vec3(1.0f);
    return scene;
}

double mean_of(const Picture& picture) {
    double sum = 0.0;
    for (const Float4& pixel : picture)
        sum += pixel.x;
    return sum / double(picture.size());
}

TEST_P(EachMode, ACheckerboardKeepsItsMean) {
    const scene::Scene scene = checkerboard();
    for (const float step : {0.0f, 0.013f}) {
        WeierFrames frames(device(), scene, of_method(GetParam()));
        for (std::uint32_t frame = 0; frame < 16; ++frame)
            frames.run(frame, moved(scene, {step * float(frame), 0, 0}));
        // A foveated frame has about 2000 samples of 0 or 1: two deviations of their mean.
        EXPECT_NEAR(mean_of(frames.read<Float4>(frames.picture())), 0.5, 0.022) << "step " << step;
    }
}

TEST_P(EachMode, WhatIsNotANumberIsGoneWithinAFrame) {
    WeierSetup setup = of_method(GetParam());
    const bool upscaled = method::find_method(GetParam()).upscaled;
    const bool smoothed = method::find_method(GetParam()).antialiased;
    setup.outputs = {"depth range"};
    if (upscaled)
        setup.outputs.insert("upscaled planes");
    if (smoothed)
        setup.outputs.insert("stable planes");
    WeierFrames frames(device(), cornell(), setup);
    for (std::uint32_t frame = 0; frame < 3; ++frame)
        frames.run(frame, moved(cornell(), {0.01f * float(frame), 0, 0}));
    const float bad[] = {NAN, INFINITY, -INFINITY, 1e38f};
    for (const std::string& name : setup.outputs) {
        compute::Buffer buffer = frames.buffer(name);
        auto values = buffer.map_update<float>();
        for (std::size_t i = 0; i < values.size(); i += 7)
            values[i] = bad[i % 4];
    }
    frames.run(3, moved(cornell(), {0.04f, 0, 0}));
    for (const Float4& value : frames.read<Float4>(frames.picture()))
        ASSERT_TRUE(is_finite(value));
}

TEST_P(EachMode, ACutForgetsTheHistoryByItself) {
    WeierSetup setup = of_method(GetParam());
    WeierFrames cut(device(), cornell(), setup), fresh(device(), cornell(), setup);
    for (std::uint32_t frame = 0; frame < 4; ++frame)
        cut.run(frame, cornell().cameras.front());
    scene::Camera elsewhere = cornell().cameras.front();
    std::swap(elsewhere.eye, elsewhere.target);
    cut.run(4, elsewhere);
    fresh.run(4, elsewhere);
    EXPECT_TRUE(same_bits(cut.read<Float4>(cut.picture()), fresh.read<Float4>(fresh.picture())));
}

TEST_P(EachMode, OneAndSixteenLanesGiveTheSameBits) {
    // At ratio 1 the history's cubic reaches the farthest beyond the disk.
    for (const float ratio : {1.8f, 1.0f}) {
        std::vector<std::string> hashes;
        for (const std::uint32_t lanes : {1u, 16u}) {
            render::Options options;
            options.width = 150;
            options.height = 90;
            options.method = GetParam();
            options.temporal.ratio = ratio;
            options.lanes = lanes;
            render::Renderer renderer(device(), cornell(), options);
            for (std::uint32_t frame = 0; frame < 3; ++frame)
                renderer.render(frame, moved(cornell(), {0.02f * float(frame), 0.01f, 0}));
            hashes.push_back(renderer.hash());
            EXPECT_EQ(renderer.map("colour").width, 150u);
        }
        EXPECT_EQ(hashes[0], hashes[1]) << "ratio " << ratio;
    }
}

INSTANTIATE_TEST_SUITE_P(Modes, EachMode,
                         testing::Values("logpolar+taa", "logpolar+upscale", "logpolar+taa+upscale",
                                         "full+upscale", "logrect+taa", "logrect+taa+upscale",
                                         "weier+upscale"),
                         [](const auto& mode) {
                             std::string name = mode.param;
                             std::replace(name.begin(), name.end(), '+', '_');
                             return name;
                         });

} // namespace
