// Method weier collapses to `full` where it must, and its history is right or absent.
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "lib/cache_info.h"
#include "lib/camera.h"
#include "scenes/load.hpp"
#include "tests/support/small_scenes.hpp"
#include "tests/support/weier_frames.hpp"

namespace {
using namespace macula;
using namespace macula::test;
using frame::LightMode;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct Float4 {
    float x, y, z, w;
};

compute::Device& device() {
    static compute::Device opened = compute::open();
    return opened;
}

const scene::Scene& cornell() {
    static const scene::Scene loaded = scene::load("cornell");
    return loaded;
}

// The scene's camera, moved sideways.
scene::Camera moved(const scene::Scene& scene, float to_the_right) {
    scene::Camera view = scene.cameras.front();
    view.eye.x += to_the_right;
    view.target.x += to_the_right;
    return view;
}

double mean_error(const std::vector<Float4>& a, const std::vector<Float4>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += std::abs(a[i].x - b[i].x) + std::abs(a[i].y - b[i].y) + std::abs(a[i].z - b[i].z);
    return sum / (3.0 * double(a.size()));
}

bool same_bits(const std::vector<Float4>& a, const std::vector<Float4>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Float4)) == 0;
}

bool is_finite(const Float4& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

// A large quad, x and y within 40, with stripes of luminance by way of two lights.
scene::Scene wall(float z) {
    scene::Mesh mesh;
    add_quad(mesh, {-40, -40, z}, {80, 0, 0}, {0, 80, 0});
    scene::Scene scene = scene_of(std::move(mesh), {{0, 0, 0}, {0, 0, -1}, 80.0f});
    scene.lights.emplace_back();
    scene.lights[0].position = {0, 0, 0};
    return scene;
}

class EachMode : public testing::TestWithParam<LightMode> {};

TEST_P(EachMode, AFullFovealRegionIsMethodFullBitForBit) {
    WeierSetup setup;
    setup.lights = GetParam();
    setup.weier.r0 = setup.weier.r1 = kInfinity;
    setup.weier.p_min = 1.0f;
    WeierFrames foveated(device(), cornell(), setup);
    setup.method = "full";
    WeierFrames full(device(), cornell(), setup);
    const float places[] = {0.0f, 0.0f, 0.02f, 0.05f, 0.05f};
    for (std::uint32_t frame = 0; frame < 5; ++frame) {
        foveated.run(frame, moved(cornell(), places[frame]));
        full.run(frame, moved(cornell(), places[frame]));
        EXPECT_TRUE(same_bits(foveated.read<Float4>("colour"), full.read<Float4>("colour")))
            << "frame " << frame;
    }
}

// A frame after a jump is that of a renderer without any past.
void expect_forgotten(LightMode lights, const scene::Camera& after) {
    WeierSetup setup;
    setup.lights = lights;
    WeierFrames jumping(device(), cornell(), setup), fresh(device(), cornell(), setup);
    for (std::uint32_t frame = 0; frame < 4; ++frame)
        jumping.run(frame, cornell().cameras.front());
    jumping.run(4, after);
    fresh.run(4, after);
    EXPECT_TRUE(same_bits(jumping.read<Float4>("colour"), fresh.read<Float4>("colour")));
}

TEST_P(EachMode, ATeleportForgetsTheHistoryByItself) {
    scene::Camera elsewhere = cornell().cameras.front();
    std::swap(elsewhere.eye, elsewhere.target);
    expect_forgotten(GetParam(), elsewhere);
}

// What was ahead still is, at another distance.
TEST_P(EachMode, ATeleportForwardsForgetsTheHistoryByItself) {
    scene::Camera ahead = cornell().cameras.front();
    const glm::vec3 step = 0.5f * (ahead.target - ahead.eye);
    ahead.eye += step;
    ahead.target += step;
    expect_forgotten(GetParam(), ahead);
}

// Without history there is nothing to reconstruct from.
TEST_P(EachMode, AFrameWithoutHistoryIsMethodFullBitForBit) {
    WeierSetup setup;
    setup.lights = GetParam();
    setup.outputs = {"history kept", "list length"};
    setup.weier.r0 = 4.0f;
    setup.weier.r1 = 8.0f;
    WeierFrames foveated(device(), cornell(), setup);
    setup.method = "full";
    setup.outputs = {};
    WeierFrames full(device(), cornell(), setup);
    scene::Camera elsewhere = cornell().cameras.front();
    std::swap(elsewhere.eye, elsewhere.target);
    const scene::Camera views[] = {cornell().cameras.front(), cornell().cameras.front(), elsewhere,
                                   elsewhere};
    const std::uint32_t pixels = setup.width * setup.height;
    for (std::uint32_t frame = 0; frame < 4; ++frame) {
        foveated.run(frame, views[frame]);
        full.run(frame, views[frame]);
        const bool first = frame % 2 == 0;
        EXPECT_EQ(foveated.read<std::uint32_t>("history kept")[0], first ? 0u : 1u) << frame;
        const std::uint32_t sampled = foveated.read<std::uint32_t>("list length")[0];
        if (first) {
            EXPECT_EQ(sampled, pixels) << frame;
            EXPECT_TRUE(same_bits(foveated.read<Float4>("colour"), full.read<Float4>("colour")))
                << frame;
        } else {
            EXPECT_LT(sampled, pixels * 2 / 3) << frame;
        }
    }
}

TEST_P(EachMode, ASparseFirstFrameSpreadsItsCost) {
    WeierSetup setup;
    setup.lights = GetParam();
    setup.outputs = {"list length"};
    setup.weier.first_frame_full = false;
    WeierFrames frames(device(), cornell(), setup);
    frames.run(0, cornell().cameras.front());
    EXPECT_LT(frames.read<std::uint32_t>("list length")[0], setup.width * setup.height / 2);
}

TEST_P(EachMode, WhatIsNotANumberIsGoneWithinAFrame) {
    WeierSetup setup;
    setup.lights = GetParam();
    setup.outputs = {"cache info", "support geometry", "support image"};
    WeierFrames frames(device(), cornell(), setup);
    for (std::uint32_t frame = 0; frame < 3; ++frame)
        frames.run(frame, moved(cornell(), 0.01f * float(frame)));
    const float bad[] = {NAN, INFINITY, -INFINITY, 1e38f};
    for (const char* name : {"colour", "support image", "support geometry"}) {
        compute::Buffer buffer = frames.buffer(name);
        auto values = buffer.map_update<float>();
        for (std::size_t i = 0; i < values.size(); i += 7)
            values[i] = bad[i % 4];
    }
    {
        compute::Buffer info = frames.buffer("cache info");
        auto words = info.map_update<float>();
        for (std::size_t i = 0; i < words.size(); i += 6)
            words[i] = bad[i % 4];
    }
    frames.run(3, moved(cornell(), 0.04f));
    for (const char* name : {"colour", "support image", "support geometry"})
        for (const Float4& value : frames.read<Float4>(name))
            ASSERT_TRUE(is_finite(value)) << name;
    const auto info = frames.read<std::uint32_t>("cache info");
    for (std::size_t i = 0; i < info.size(); i += 2) {
        const float rho = std::bit_cast<float>(info[i]);
        ASSERT_TRUE(rho >= 0.0f && rho < 1e6f) << rho;
    }
}

INSTANTIATE_TEST_SUITE_P(Lights, EachMode,
                         testing::Values(LightMode::point, LightMode::area, LightMode::soft,
                                         LightMode::ambient_occlusion),
                         [](const auto& mode) { return std::string(frame::name(mode.param)); });

TEST(StillView, ConvergesToTheReference) {
    WeierSetup setup;
    setup.weier.r0 = 4.0f;
    setup.weier.r1 = 8.0f;
    setup.weier.p_min = 0.2f;
    setup.weier.first_frame_full = false; // else there is nothing to converge
    WeierFrames foveated(device(), cornell(), setup);
    setup.method = "full";
    WeierFrames full(device(), cornell(), setup);
    full.run(0, cornell().cameras.front());
    const auto reference = full.read<Float4>("colour");
    double last = 1e9;
    for (std::uint32_t frame = 0; frame < 40; ++frame) {
        foveated.run(frame, cornell().cameras.front());
        const double error = mean_error(foveated.read<Float4>("colour"), reference);
        EXPECT_LE(error, last) << frame;
        last = error;
    }
    EXPECT_LT(last, 1e-4);
}

// Point lights have no noise: what was sampled once stays as it is.
TEST(StillView, KeepsItsFullFirstFrame) {
    WeierSetup setup;
    WeierFrames foveated(device(), cornell(), setup);
    foveated.run(0, cornell().cameras.front());
    const auto first = foveated.read<Float4>("colour");
    for (std::uint32_t frame = 1; frame < 6; ++frame) {
        foveated.run(frame, cornell().cameras.front());
        EXPECT_TRUE(same_bits(foveated.read<Float4>("colour"), first)) << frame;
    }
}

TEST(StillView, ConvergesUnderAreaLightsUntilTheWeightLimit) {
    WeierSetup setup;
    setup.lights = LightMode::area;
    setup.weier.r0 = setup.weier.r1 = 0.0f;
    setup.weier.p_min = 0.5f;
    setup.weier.luminance_threshold = 1.0f;
    setup.weier.first_frame_full = false;
    WeierFrames foveated(device(), cornell(), setup);
    setup.method = "full";
    setup.samples = 1024;
    WeierFrames full(device(), cornell(), setup);
    full.run(0, cornell().cameras.front());
    const auto reference = full.read<Float4>("colour");
    std::vector<double> errors;
    for (std::uint32_t frame = 0; frame < 24; ++frame) {
        foveated.run(frame, cornell().cameras.front());
        errors.push_back(mean_error(foveated.read<Float4>("colour"), reference));
    }
    EXPECT_LT(errors[8], 0.75 * errors[1]);
    EXPECT_LT(errors[23], 0.5 * errors[1]);
}

TEST(StillView, IsReprojectedToItself) {
    WeierSetup setup;
    setup.outputs = {"reprojected colour", "resampling"};
    WeierFrames frames(device(), cornell(), setup);
    frames.run(0, cornell().cameras.front());
    for (std::uint32_t frame = 1; frame < 4; ++frame) {
        const auto before = frames.read<Float4>("colour");
        frames.run(frame, cornell().cameras.front());
        const auto after = frames.read<Float4>("reprojected colour");
        const auto errors = frames.read<std::uint32_t>("resampling");
        std::size_t kept = 0;
        for (std::size_t i = 0; i < before.size(); ++i) {
            if (errors[i] != 0)
                continue;
            ++kept;
            ASSERT_EQ(std::memcmp(&before[i], &after[i], sizeof(Float4)), 0) << "pixel " << i;
        }
        EXPECT_GT(kept, before.size() * 2 / 5) << "the rest are edges, which are sampled anew";
    }
}

// A plane's history is where the camera's movement says, to a twentieth of a pixel: the last frame
// holds the column and row of each of its pixels as its colour.
TEST(MovingView, APlaneIsReprojectedToASubPixelError) {
    WeierSetup setup;
    setup.width = 200;
    setup.height = 160;
    setup.outputs = {"reprojected colour"};
    const scene::Scene scene = wall(-5.0f);
    WeierFrames frames(device(), scene, setup);
    scene::Camera view = scene.cameras.front();
    // Oblique: the plane's depth varies over the image.
    view.target = {0.5f, 0.2f, -1.0f};
    frames.run(0, view);
    {
        compute::Buffer colour = frames.buffer("colour");
        auto values = colour.map_update<Float4>();
        for (std::uint32_t i = 0; i < values.size(); ++i)
            values[i] = {float(i % 200) + 0.5f, float(i / 200) + 0.5f, 0.0f, 1.0f};
    }
    const shared::Camera before = frames.params.camera;
    view.eye += glm::vec3(0.06f, 0.03f, -0.05f);
    view.target += glm::vec3(0.06f, 0.03f, -0.05f);
    frames.run(1, view);
    const shared::Camera& now = frames.params.camera;
    const auto found = frames.read<Float4>("reprojected colour");
    std::size_t compared = 0;
    double worst = 0.0, largest_motion = 0.0;
    for (std::uint32_t y = 1; y < 159; ++y) {
        for (std::uint32_t x = 1; x < 199; ++x) {
            const shared::float3 d = shared::camera_direction(&now, 200, 160, x + 0.5f, y + 0.5f);
            const double t = (-5.0 - now.origin[2]) / d.z;
            const shared::float3 past = {float(now.origin[0] + t * d.x - before.origin[0]),
                                         float(now.origin[1] + t * d.y - before.origin[1]),
                                         float(-5.0 - before.origin[2])};
            float u = 0.0f, v = 0.0f;
            ASSERT_TRUE(shared::camera_project(&before, 200, 160, past, &u, &v));
            const Float4& colour = found[y * 200 + x];
            // Half a texel off the edge the bilinear filter has only one side.
            if (colour.w == 0.0f || u < 1.0f || v < 1.0f || u > 199.0f || v > 159.0f)
                continue;
            ++compared;
            worst =
                std::max({worst, std::abs(double(colour.x) - u), std::abs(double(colour.y) - v)});
            largest_motion = std::max(largest_motion, std::abs(double(u) - (x + 0.5)));
        }
    }
    EXPECT_GT(compared, 25000u);
    EXPECT_GT(largest_motion, 1.0);
    EXPECT_LT(worst, 0.05) << "pixels";
}

// A red board in front of a blue wall.
scene::Scene board_and_wall() {
    scene::Mesh mesh;
    add_quad(mesh, {-40, -40, -20}, {80, 0, 0}, {0, 80, 0}, 0);
    add_quad(mesh, {-1, -1, -4}, {2, 0, 0}, {0, 2, 0});
    scene::Scene scene = scene_of(std::move(mesh), {{0, 0, 0}, {0, 0, -1}, 70.0f});
    scene.materials.resize(2);
    scene.meshes[0].triangle_material = {0, 0, 1, 1};
    scene.materials[0].diffuse = glm::vec3(0.0f);
    scene.materials[0].emission = glm::vec3(0.0f, 0.0f, 0.5f);
    scene.materials[1].diffuse = glm::vec3(0.0f);
    scene.materials[1].emission = glm::vec3(1.0f, 0.0f, 0.0f);
    return scene;
}

// The eye moves from `from` by `step` a frame: no pixel of the wall may show the board, and the
// board none of the wall.
void expect_no_stale_pixels(const glm::vec3& from, const glm::vec3& step, std::uint32_t frames) {
    const scene::Scene scene = board_and_wall();
    WeierSetup setup;
    setup.width = 220;
    setup.height = 180;
    setup.outputs = {"resampling"};
    setup.weier.luminance_threshold = 1.0f; // depth alone must do
    WeierFrames foveated(device(), scene, setup);
    setup.method = "full";
    setup.outputs = {};
    WeierFrames full(device(), scene, setup);
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
        scene::Camera view = scene.cameras.front();
        view.eye += from + float(frame) * step;
        view.target += from + float(frame) * step;
        foveated.run(frame, view);
        full.run(frame, view);
        const auto ours = foveated.read<Float4>("colour"), truth = full.read<Float4>("colour");
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < ours.size(); ++i)
            wrong += std::abs(ours[i].x - truth[i].x) > 0.5f ? 1 : 0;
        EXPECT_EQ(wrong, 0u) << "frame " << frame;
    }
}

// What the board uncovers was never seen.
TEST(MovingView, UncoveredPixelsNeverShowHistory) {
    expect_no_stale_pixels({0.0f, 0.0f, 0.0f}, {0.1f, 0.0f, 0.0f}, 12);
}

// The board leaves over each edge, while the wall hardly moves.
TEST(MovingView, WhatLeavesTheViewDoesNotStayAtItsEdge) {
    expect_no_stale_pixels({4.2f, 0.0f, 0.0f}, {0.02f, 0.0f, 0.0f}, 24);
    expect_no_stale_pixels({-4.2f, 0.0f, 0.0f}, {-0.02f, 0.0f, 0.0f}, 24);
    expect_no_stale_pixels({0.0f, 3.6f, 0.0f}, {0.0f, 0.02f, 0.0f}, 24);
    expect_no_stale_pixels({0.0f, -3.6f, 0.0f}, {0.0f, -0.02f, 0.0f}, 24);
}

TEST(ManyFrames, MemoryIsFlatAndNothingDrifts) {
    WeierSetup setup;
    setup.width = 40;
    setup.height = 32;
    WeierFrames frames(device(), cornell(), setup);
    frames.run(0, cornell().cameras.front());
    const std::uint64_t bytes = frames.device.allocated_bytes();
    for (std::uint32_t frame = 1; frame < 200; ++frame)
        frames.run(frame, cornell().cameras.front());
    const auto settled = frames.read<Float4>("colour");
    for (std::uint32_t frame = 200; frame < 400; ++frame)
        frames.run(frame, cornell().cameras.front());
    EXPECT_EQ(frames.device.allocated_bytes(), bytes);
    EXPECT_LT(mean_error(frames.read<Float4>("colour"), settled), 1e-4);
}

} // namespace
