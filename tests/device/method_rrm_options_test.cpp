// Method rrm's options beyond the paper: the disk, foveal supersampling, rings and busy groups; and
// that neither lanes nor traversal variants change a bit.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/load.hpp"
#include "tests/support/small_scenes.hpp"
#include "tests/support/weier_frames.hpp"

namespace {
using namespace macula;
using namespace macula::test;
using Words = std::vector<std::uint32_t>;

compute::Device& device() {
    static compute::Device opened = compute::open();
    return opened;
}

const scene::Scene& cornell() {
    static const scene::Scene loaded = scene::load("cornell");
    return loaded;
}

const scene::Camera& view() {
    return cornell().cameras.front();
}

WeierSetup rrm() {
    WeierSetup setup;
    setup.method = "rrm";
    setup.outputs = {"cache age"};
    setup.rrm.first_frame_full = false;
    return setup;
}

// How often each pixel is refreshed in 24 frames.
Words refreshes(WeierFrames& frames, const frame::Gaze& gaze = {}) {
    Words count(96 * 80);
    for (std::uint32_t frame = 0; frame < 24; ++frame) {
        frames.run(frame, view(), gaze);
        const Words age = frames.read<std::uint32_t>("cache age");
        for (std::size_t i = 0; i < age.size(); ++i)
            count[i] += age[i] == 0 ? 1 : 0;
    }
    return count;
}

double eccentricity(const shared::FrameParams& p, double x, double y) {
    const double sx = x / p.width * (p.camera.tan_left + p.camera.tan_right) - p.camera.tan_left;
    const double sy = p.camera.tan_up - y / p.height * (p.camera.tan_up + p.camera.tan_down);
    double along = 0.0, length = 0.0;
    for (int i = 0; i < 3; ++i) {
        const double d = p.camera.right[i] * sx + p.camera.up[i] * sy + p.camera.forward[i];
        along += d * p.gaze[i];
        length += d * d;
    }
    return std::acos(std::min(along / std::sqrt(length), 1.0)) * 180.0 / std::numbers::pi;
}

TEST(Disk, HoldsTheBlocksWithTheirMiddlesInIt) {
    WeierSetup setup = rrm();
    setup.rrm.disk = true;
    setup.rrm.fovea = 12.0f;
    WeierFrames frames(device(), cornell(), setup);
    const Words count = refreshes(frames, gaze_through(view(), 30.0f, 47.0f));
    std::uint32_t foveal = 0;
    for (std::uint32_t i = 0; i < count.size(); ++i) {
        const double x = i % 96 / 2 * 2 + 1.0, y = i / 96 / 2 * 2 + 1.0;
        const double e = eccentricity(frames.params, x, y);
        if (std::fabs(e - 12.0) < 1e-3)
            continue;
        ASSERT_EQ(count[i], e < 12.0 ? 24u : 2u) << i;
        foveal += e < 12.0 ? 1 : 0;
    }
    EXPECT_GT(foveal, 100u);
}

TEST(FovealRectangle, IsTheSmallestAroundTheDisk) {
    WeierFrames frames(device(), cornell(), rrm());
    for (const auto& [x, y] : {std::pair{48.0f, 40.0f}, {10.0f, 70.0f}, {120.0f, -30.0f}}) {
        frames.run(0, view(), gaze_through(view(), x, y));
        const auto r = stage::foveal_rectangle(frames.params, 9.0f, 2);
        std::uint32_t x0 = 96, x1 = 0, y0 = 80, y1 = 0;
        constexpr std::uint32_t fine = 8; // points of a pixel along each axis
        for (std::uint32_t j = 0; j < 80 * fine; ++j)
            for (std::uint32_t i = 0; i < 96 * fine; ++i)
                if (eccentricity(frames.params, (i + 0.5) / fine, (j + 0.5) / fine) < 9.0) {
                    x0 = std::min(x0, i / fine);
                    x1 = std::max(x1, i / fine + 1);
                    y0 = std::min(y0, j / fine);
                    y1 = std::max(y1, j / fine + 1);
                }
        if (x0 >= x1)
            continue;
        // Of a pixel at the edge the middle counts, and blocks have two pixels.
        EXPECT_NEAR(r.x0, x0, 2);
        EXPECT_NEAR(r.x1, x1, 2);
        EXPECT_NEAR(r.y0, y0, 2);
        EXPECT_NEAR(r.y1, y1, 2);
    }
}

TEST(FovealSamples, AreThoseOfMethodFullInTheFoveaAlone) {
    WeierSetup setup = rrm();
    setup.rrm.foveal_samples = 4;
    setup.rrm.fovea = 15.0f;
    setup.lights = frame::LightMode::area;
    WeierFrames frames(device(), cornell(), setup);
    WeierSetup one = setup, four = setup;
    one.method = four.method = "full";
    one.outputs = four.outputs = {};
    four.samples_per_pixel = 4;
    WeierFrames coarse(device(), cornell(), one), fine(device(), cornell(), four);
    for (std::uint32_t frame = 0; frame < 2; ++frame) {
        frames.run(frame, view());
        coarse.run(frame, view());
        fine.run(frame, view());
        const Words colour = frames.read<std::uint32_t>("colour");
        const Words age = frames.read<std::uint32_t>("cache age");
        const Words of_one = coarse.read<std::uint32_t>("colour");
        const Words of_four = fine.read<std::uint32_t>("colour");
        const auto r = stage::foveal_rectangle(frames.params, 15.0f, 2);
        for (std::uint32_t i = 0; i < age.size(); ++i) {
            const std::uint32_t x = i % 96, y = i / 96;
            const bool foveal = x >= r.x0 && x < r.x1 && y >= r.y0 && y < r.y1;
            for (std::uint32_t k = 4 * i; age[i] == 0 && k < 4 * i + 4; ++k)
                ASSERT_EQ(colour[k], (foveal ? of_four : of_one)[k]) << i;
        }
    }
}

TEST(Rings, RefreshEveryPixelAtLeastAsOftenAsItsEccentricityAsks) {
    WeierSetup setup = rrm();
    setup.rrm.rings = {{10.0f, 3}, {18.0f, 6}};
    WeierFrames frames(device(), cornell(), setup);
    const Words count = refreshes(frames, gaze_through(view(), 30.0f, 40.0f));
    std::array<std::uint32_t, 25> pixels{};
    for (std::uint32_t i = 0; i < count.size(); ++i) {
        const double e = eccentricity(frames.params, i % 96 + 0.5, i / 96 + 0.5);
        ASSERT_GE(count[i], e < 10.0 ? 8u : e < 18.0 ? 4u : 2u) << i;
        ++pixels[count[i]];
    }
    // Exactly one of the four rates.
    EXPECT_EQ(pixels[24] + pixels[8] + pixels[4] + pixels[2], count.size());
    for (const std::uint32_t times : {24u, 8u, 4u, 2u})
        EXPECT_GT(pixels[times], 0u);
}

// A bright square before a dark wall, moved to the right by `way`.
scene::Scene moving_square() {
    scene::Mesh wall, square;
    add_quad(wall, {-40, -40, -6}, {80, 0, 0}, {0, 80, 0});
    add_quad(square, {-1.5f, -0.5f, -4}, {1, 0, 0}, {0, 1, 0});
    square.triangle_material.assign(2, 1);
    scene::Scene scene = scene_of(std::move(wall), {{0, 0, 0}, {0, 0, -1}, 60.0f});
    scene.materials.push_back(scene.materials[0]);
    scene.materials[0].diffuse = scene.materials[1].diffuse = glm::vec3(0.0f);
    scene.materials[1].emission = glm::vec3(1.0f);
    scene.meshes.push_back(std::move(square));
    scene.instances.push_back({1, {}, "square"});
    scene::validate(scene);
    scene.lights.clear();
    return scene;
}

void move(WeierFrames& frames, float way) {
    std::array<scene::Transform, 2> transforms;
    transforms[1].row[0].w = way;
    frames.place(transforms);
}

TEST(MovingObject, LeavesNoTrailOlderThanACycle) {
    const scene::Scene scene = moving_square();
    const scene::Camera& camera = scene.cameras.front();
    WeierSetup setup = rrm();
    setup.geometry.merge_static = false;
    WeierFrames frames(device(), scene, setup);
    setup.method = "full";
    setup.outputs = {};
    WeierFrames full(device(), scene, setup);
    for (std::uint32_t frame = 0; frame < 24; ++frame) {
        if (frame < 12) {
            move(frames, 0.1f * static_cast<float>(frame));
            move(full, 0.1f * static_cast<float>(frame));
        }
        frames.run(frame, camera, gaze_through(camera, 80.0f, 10.0f));
    }
    full.run(23, camera);
    EXPECT_EQ(frames.read<std::uint32_t>("colour"), full.read<std::uint32_t>("colour"));
}

// Rays of a frame in which the square has moved, and of one long after.
std::pair<std::uint64_t, std::uint64_t> rays_of_motion(const stage::BusyOptions& busy) {
    const scene::Scene scene = moving_square();
    const scene::Camera& camera = scene.cameras.front();
    WeierSetup setup = rrm();
    setup.geometry.merge_static = false;
    setup.rrm.busy = busy;
    setup.rrm.fovea = 0.0f;
    WeierFrames frames(device(), scene, setup);
    const frame::Gaze away = gaze_through(camera, 300.0f, 10.0f);
    std::uint64_t moved = 0, last = 0;
    for (std::uint32_t frame = 0; frame < 80; ++frame) {
        move(frames, 0.1f * static_cast<float>(std::clamp(frame, 24u, 36u) - 24u));
        const std::uint64_t before = frames.rays(kernel::RayClass::sparse);
        frames.run(frame, camera, away);
        last = frames.rays(kernel::RayClass::sparse) - before;
        moved = frame == 34 ? last : moved;
    }
    return {moved, last};
}

TEST(BusyGroups, AreRefreshedMoreOftenWithinTheBudgetAndThenCalmDown) {
    const std::uint64_t share = 96 * 80 / 12;
    for (const bool by_motion : {false, true}) {
        stage::BusyOptions busy;
        (by_motion ? busy.motion : busy.change) = by_motion ? 0.5f : 0.1f;
        busy.budget = 0.5f;
        const auto [free, calm] = rays_of_motion(busy);
        EXPECT_GT(free, share);
        EXPECT_EQ(calm, share);
        busy.budget = 0.0125f; // two packets' groups, three packets each
        EXPECT_EQ(rays_of_motion(busy).first, share + 96);
    }
    EXPECT_EQ(rays_of_motion({}).first, share);
}

TEST(Bits, AreTheSameForAllLanesAndVariants) {
    const scene::Scene scene = scene::load("cornell_spheres");
    render::Options options;
    options.width = 61;
    options.height = 45;
    options.method = "rrm";
    options.depth = 2;
    options.rrm.disk = true;
    options.rrm.rings = {{15.0f, 3}};
    options.rrm.foveal_samples = 2;
    options.rrm.busy.change = 0.01f;
    const auto hash = [&](std::uint32_t lanes, const char* variant) {
        options.lanes = lanes;
        options.variant = variant;
        render::Renderer renderer(device(), scene, options);
        for (std::uint32_t frame = 0; frame < 4; ++frame)
            renderer.render(frame);
        return renderer.hash();
    };
    const std::string expected = hash(1, "while_while");
    EXPECT_EQ(hash(16, "while_while"), expected);
    EXPECT_EQ(hash(16, "wide8"), expected);
    EXPECT_EQ(hash(16, "packet_stream"), expected);
}

} // namespace
