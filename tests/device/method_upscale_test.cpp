// What gathers samples over frames: where it must be exact, where it must converge, and what no
// history may show.
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "scenes/load.hpp"
#include "tests/support/small_scenes.hpp"
#include "tests/support/weier_frames.hpp"

namespace {
using namespace macula;
using namespace macula::test;

struct Float4 {
    float x, y, z, w;
};
using Picture = std::vector<Float4>;

compute::Device& device() {
    static compute::Device opened = compute::open();
    return opened;
}

const scene::Scene& cornell() {
    static const scene::Scene loaded = scene::load("cornell");
    return loaded;
}

WeierSetup of_method(const char* method) {
    WeierSetup setup;
    setup.method = method;
    return setup;
}

// The foveal disk covers the image: what is left is the method's smoothing or enlarging.
WeierSetup whole_disk(const char* method) {
    WeierSetup setup = of_method(method);
    setup.log_polar.disk = 3.0f;
    return setup;
}

scene::Camera moved(const scene::Scene& scene, glm::vec3 by) {
    scene::Camera view = scene.cameras.front();
    view.eye += by;
    view.target += by;
    return view;
}

bool same_bits(const Picture& a, const Picture& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Float4)) == 0;
}

bool is_finite(const Float4& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

double mean_error(const Picture& a, const Picture& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += std::abs(a[i].x - b[i].x) + std::abs(a[i].y - b[i].y) + std::abs(a[i].z - b[i].z);
    return sum / (3.0 * double(a.size()));
}

TEST(Jitter, IsHaltonsSequenceAboutThePixelsMiddle) {
    EXPECT_EQ(frame::jitter_of(7, 0).x, 0.0f);
    EXPECT_EQ(frame::jitter_of(0, 64).x, 0.0f);
    EXPECT_FLOAT_EQ(frame::jitter_of(0, 64).y, 1.0f / 3.0f - 0.5f);
    EXPECT_FLOAT_EQ(frame::jitter_of(2, 64).x, 0.75f - 0.5f);
    EXPECT_FLOAT_EQ(frame::jitter_of(3, 64).y, 4.0f / 9.0f - 0.5f);
    EXPECT_EQ(frame::jitter_of(5, 64).x, frame::jitter_of(69, 64).x);
}

TEST(Jitter, RepeatsAfterSixteenFramesForEachRenderedPixel) {
    const method::TemporalOptions twice{.ratio = 2.0f}, defaults;
    EXPECT_EQ(method::find_method("full").jitter_phases(1920, defaults), 0u);
    EXPECT_EQ(method::find_method("logpolar+taa").jitter_phases(1920, defaults), 16u);
    EXPECT_EQ(method::find_method("full+upscale").jitter_phases(1920, defaults), 64u);
    EXPECT_EQ(method::find_method("full+upscale").jitter_phases(1920, twice), 64u);
}

TEST(RenderSize, IsThePictureDividedByTheRatio) {
    const method::Method& m = method::find_method("logpolar+taa+upscale");
    EXPECT_EQ(m.render_size(1920, 1080, {}).width, 1067u);
    EXPECT_EQ(m.render_size(1920, 1080, {}).height, 600u);
    EXPECT_EQ(m.render_size(1, 1, {.ratio = 4.0f}).height, 1u);
    EXPECT_EQ(method::find_method("logpolar").render_size(50, 40, {}).width, 50u);
    for (const float bad : {0.9f, 4.1f, NAN})
        EXPECT_THROW(m.render_size(64, 64, {.ratio = bad}), std::invalid_argument);
}

TEST(Upscale, ByOneWithoutJitterReturnsItsInput) {
    for (const char* method : {"full+upscale", "weier+upscale"}) {
        WeierSetup setup = of_method(method);
        setup.temporal.ratio = 1.0f;
        setup.jitter = false;
        WeierFrames frames(device(), cornell(), setup);
        for (std::uint32_t frame = 0; frame < 4; ++frame) {
            frames.run(frame, moved(cornell(), {0.02f * float(frame / 2), 0, 0}));
            EXPECT_TRUE(
                same_bits(frames.read<Float4>(frames.picture()), frames.read<Float4>("colour")))
                << method << ", frame " << frame;
        }
    }
}

TEST(Antialiasing, WithoutAHistoryReturnsItsInput) {
    WeierFrames frames(device(), cornell(), of_method("logpolar+taa"));
    for (std::uint32_t frame = 0; frame < 2; ++frame) {
        frames.run(2 * frame, cornell().cameras.front());
        EXPECT_TRUE(same_bits(frames.read<Float4>("stable colour"), frames.read<Float4>("colour")));
        frames.run(2 * frame + 1, cornell().cameras.front());
        EXPECT_FALSE(
            same_bits(frames.read<Float4>("stable colour"), frames.read<Float4>("colour")));
        frames.forget();
    }
}

TEST(Antialiasing, OfAStillViewConvergesToTheMeanOverTheJitter) {
    for (const bool disk : {true, false}) {
        WeierFrames frames(device(), cornell(),
                           disk ? whole_disk("logpolar+taa") : of_method("logpolar+taa"));
        constexpr std::uint32_t kCycle = 16;
        std::vector<Picture> smoothed;
        Picture mean;
        for (std::uint32_t frame = 0; frame < 4 * kCycle; ++frame) {
            frames.run(frame, cornell().cameras.front());
            smoothed.push_back(frames.read<Float4>("stable colour"));
            const Picture now = frames.read<Float4>("colour");
            mean.resize(now.size(), {});
            for (std::size_t i = 0; i < now.size(); ++i) {
                mean[i].x += now[i].x / (4 * kCycle);
                mean[i].y += now[i].y / (4 * kCycle);
                mean[i].z += now[i].z / (4 * kCycle);
            }
        }
        const double first = mean_error(smoothed[0], mean);
        const double later = mean_error(smoothed[kCycle - 1], mean);
        const double last = mean_error(smoothed.back(), mean);
        // Beyond the disk a texel's jitter goes from surface to surface, and what is taken for
        // another one starts anew.
        EXPECT_LT(later, 0.5 * first) << "disk " << disk;
        EXPECT_LT(last, (disk ? 0.2 : 0.45) * first) << "disk " << disk;
    }
}

TEST(Upscale, OfAStillViewComesCloserToTheTruthThanAPictureOfOneSample) {
    WeierFrames frames(device(), cornell(), of_method("full+upscale"));
    WeierSetup setup = of_method("full");
    WeierFrames full(device(), cornell(), setup);
    setup.samples_per_pixel = 64;
    WeierFrames truth(device(), cornell(), setup);
    full.run(0, cornell().cameras.front());
    truth.run(0, cornell().cameras.front());
    const Picture reference = truth.read<Float4>("colour");
    std::vector<double> errors;
    for (std::uint32_t frame = 0; frame < 64; ++frame) {
        frames.run(frame, cornell().cameras.front());
        errors.push_back(mean_error(frames.read<Float4>(frames.picture()), reference));
    }
    EXPECT_LT(errors[15], 0.7 * errors[0]);
    EXPECT_LT(errors[63], errors[15]);
    EXPECT_LT(errors[63], mean_error(full.read<Float4>("colour"), reference));
}

TEST(Upscale, AfterMethodWeierConvergesInAStillView) {
    WeierSetup setup = of_method("weier+upscale");
    WeierFrames frames(device(), cornell(), setup);
    setup.method = "full";
    setup.samples_per_pixel = 64;
    WeierFrames truth(device(), cornell(), setup);
    truth.run(0, cornell().cameras.front());
    const Picture reference = truth.read<Float4>("colour");
    std::vector<double> errors;
    for (std::uint32_t frame = 0; frame < 64; ++frame) {
        frames.run(frame, cornell().cameras.front());
        errors.push_back(mean_error(frames.read<Float4>(frames.picture()), reference));
    }
    EXPECT_LT(errors[15], 0.9 * errors[0]);
    EXPECT_LT(errors[63], errors[15]);
}

TEST(Upscale, AfterAFullFovealRegionIsThatAfterMethodFullBitForBit) {
    WeierSetup setup = of_method("weier+upscale");
    setup.weier.r0 = setup.weier.r1 = INFINITY;
    setup.weier.p_min = 1.0f;
    WeierFrames foveated(device(), cornell(), setup);
    setup.method = "full+upscale";
    WeierFrames full(device(), cornell(), setup);
    for (std::uint32_t frame = 0; frame < 5; ++frame) {
        const scene::Camera view = moved(cornell(), {0.02f * float(frame / 2), 0, 0});
        foveated.run(frame, view);
        full.run(frame, view);
        EXPECT_TRUE(
            same_bits(foveated.read<Float4>(foveated.picture()), full.read<Float4>(full.picture())))
            << "frame " << frame;
    }
}

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

// A box whose front is red and whose right side is blue, before a black wall.
scene::Scene two_sided_box() {
    scene::Mesh wall, box;
    add_quad(wall, {-40, -40, -20}, {80, 0, 0}, {0, 80, 0}, 0);
    add_quad(box, {-1, -1, 0.3f}, {2, 0, 0}, {0, 2, 0}, 1);
    add_quad(box, {1, -1, 0.3f}, {0, 0, -0.6f}, {0, 2, 0}, 2);
    scene::Scene scene = scene_of(std::move(wall), {{1, 0, 6}, {1, 0, 0}, 20.0f});
    scene.meshes.push_back(std::move(box));
    scene.instances.push_back({1, {}, "box"});
    scene.materials.resize(3);
    for (scene::Material& material : scene.materials)
        material.diffuse = material.emission = glm::vec3(0.0f);
    scene.materials[1].emission = glm::vec3(1.0f, 0.0f, 0.0f);
    scene.materials[2].emission = glm::vec3(0.0f, 0.0f, 1.0f);
    return scene;
}

// All pixels around one show that colour alone.
bool shows(const Picture& picture, int width, int height, int x, int y, int reach, bool red) {
    if (x < reach || y < reach || x + reach >= width || y + reach >= height)
        return false;
    bool all = true;
    for (int j = -reach; j <= reach; ++j)
        for (int i = -reach; i <= reach; ++i) {
            const Float4& c = picture[std::size_t((y + j) * width + x + i)];
            all = all && c.x == (red ? 1.0f : 0.0f) && c.z == (red ? 0.0f : 1.0f);
        }
    return all;
}

TEST_P(EachMode, ASideThatTurnsUpTakesNoHistoryFromTheOneBesideIt) {
    const scene::Scene scene = two_sided_box();
    for (const float disk : {3.0f, 0.2f}) {
        WeierSetup setup = of_method(GetParam());
        setup.width = 150;
        setup.height = 120;
        setup.log_polar.disk = disk;
        setup.temporal.ratio = 1.0f;
        setup.geometry.merge_static = false;
        setup.outputs = {"followed motion"};
        WeierFrames frames(device(), scene, setup);
        Picture before;
        int turned_up = 0, kept = 0, followed = 0;
        for (std::uint32_t frame = 0; frame < 6; ++frame) {
            const float angle = frame % 2 == 0 ? -0.15f : 0.2f;
            scene::Transform there;
            there.row[0] = {std::cos(angle), 0, std::sin(angle), 0};
            there.row[2] = {-std::sin(angle), 0, std::cos(angle), 0};
            frames.place(std::vector{scene::Transform{}, there});
            frames.run(frame, scene.cameras.front());
            const Picture now = frames.read<Float4>("colour");
            const auto motion = frames.read<float>("followed motion");
            for (int y = 0; frame > 0 && y < 120; ++y)
                for (int x = 0; x < 150; ++x) {
                    const auto i = std::size_t(y * 150 + x);
                    followed += std::abs(motion[i]) < 100.0f ? 1 : 0;
                    // It was behind the edge, where the front was in sight.
                    if (!shows(now, 150, 120, x, y, 2, false))
                        continue;
                    const int from = x + int(std::lround(motion[i]));
                    const bool is_kept = std::abs(motion[i]) < 100.0f;
                    kept += is_kept && shows(before, 150, 120, from, y, 1, true) ? 1 : 0;
                    turned_up += is_kept ? 0 : 1;
                }
            before = now;
        }
        EXPECT_GT(turned_up, 100) << "disk " << disk;
        // Beyond the disk a pixel's neighbours are samples that lie further away.
        EXPECT_LE(kept, disk > 1.0f ? 0 : 5) << "disk " << disk;
        EXPECT_GT(followed, 2 * 150 * 120) << "disk " << disk;
    }
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
    std::vector<std::string> hashes;
    for (const std::uint32_t lanes : {1u, 16u}) {
        render::Options options;
        options.width = 150;
        options.height = 90;
        options.method = GetParam();
        options.lanes = lanes;
        render::Renderer renderer(device(), cornell(), options);
        for (std::uint32_t frame = 0; frame < 3; ++frame)
            renderer.render(frame, moved(cornell(), {0.02f * float(frame), 0.01f, 0}));
        hashes.push_back(renderer.hash());
        EXPECT_EQ(renderer.map("colour").width, 150u);
    }
    EXPECT_EQ(hashes[0], hashes[1]);
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
