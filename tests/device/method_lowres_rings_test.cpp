// Method lowres_rings: where it is `full`, how many blocks it samples, and what its blur keeps.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "lib/rings.h"
#include "scenes/load.hpp"
#include "tests/support/small_scenes.hpp"
#include "tests/support/weier_frames.hpp"

namespace {
using namespace macula;
using namespace macula::test;
using frame::LightMode;

compute::Device& device() {
    static compute::Device opened = compute::open();
    return opened;
}

const scene::Scene& cornell() {
    static const scene::Scene loaded = scene::load("cornell");
    return loaded;
}

WeierSetup rings(std::array<float, 3> edges) {
    WeierSetup setup;
    setup.method = "lowres_rings";
    setup.rings.edges = edges;
    return setup;
}

class EachMode : public testing::TestWithParam<LightMode> {};

TEST_P(EachMode, AFoveaOverTheWholeImageIsMethodFullBitForBit) {
    WeierSetup setup = rings({90.0f, 90.0f, 180.0f});
    setup.lights = GetParam();
    setup.depth = 2;
    const scene::Scene spheres = scene::load("cornell_spheres");
    WeierFrames foveated(device(), spheres, setup);
    setup.method = "full";
    WeierFrames full(device(), spheres, setup);
    const scene::Camera& view = spheres.cameras.front();
    full.run(5, view);
    for (const float x : {48.0f, -20.0f}) {
        foveated.run(5, view, gaze_through(view, x, 30.0f));
        EXPECT_EQ(foveated.read<std::uint32_t>("colour"), full.read<std::uint32_t>("colour"));
    }
}

INSTANTIATE_TEST_SUITE_P(Lights, EachMode,
                         testing::Values(LightMode::point, LightMode::soft,
                                         LightMode::ambient_occlusion),
                         [](const auto& mode) { return std::string(frame::name(mode.param)); });

TEST(Fovea, IsThatOfMethodFullBitForBit) {
    WeierFrames foveated(device(), cornell(), rings({5.0f, 7.0f, 11.0f}));
    WeierSetup setup;
    setup.method = "full";
    WeierFrames full(device(), cornell(), setup);
    const scene::Camera& view = cornell().cameras.front();
    full.run(0, view);
    const auto expected = full.read<std::uint32_t>("colour");
    for (const float x : {48.0f, 1.3f}) {
        foveated.run(0, view, gaze_through(view, x, 33.7f));
        const auto found = foveated.read<std::uint32_t>("colour");
        const auto where = foveated.read<shared::Rings>("rings").front();
        int inside = 0;
        for (int y = std::max(where.top[0], 0); y < std::min(where.bottom[0], 80); ++y)
            for (int px = std::max(where.left[0], 0); px < std::min(where.right[0], 96); ++px)
                for (int c = 0; c < 4; ++c, ++inside)
                    ASSERT_EQ(found[(y * 96 + px) * 4 + c], expected[(y * 96 + px) * 4 + c]);
        EXPECT_GT(inside, 100);
    }
}

TEST(Edges, LieAtTheirAngleFromTheGazeAlongEachAxis) {
    const scene::Camera& view = cornell().cameras.front();
    const auto tangents = frame::tangents_of(view.vertical_fov_degrees, 96, 80);
    WeierFrames frames(device(), cornell(), rings({4.0f, 9.0f, 15.0f}));
    for (const float x : {48.0f, 80.0f, 150.0f}) {
        frames.run(0, view, gaze_through(view, x, 40.0f));
        const auto where = frames.read<shared::Rings>("rings").front();
        const double slope = (tangents.left + tangents.right) / 96.0;
        const double gaze = std::atan(x * slope - tangents.left);
        for (int k = 0; k < 3; ++k) {
            const double edge = std::array{4.0, 9.0, 15.0}[std::size_t(k)] / 57.29577951;
            const double left = (std::tan(gaze - edge) + tangents.left) / slope;
            const double right = (std::tan(gaze + edge) + tangents.left) / slope;
            const int block = 2 << k;
            EXPECT_EQ(where.left[k], std::clamp(int(std::floor(left / block)) * block, -8, 104));
            EXPECT_EQ(where.right[k], std::clamp(int(std::ceil(right / block)) * block, -8, 104));
        }
    }
}

// Blocks by brute force: each pixel's, told apart by where it begins and how wide it is.
std::uint64_t blocks_in(const shared::Rings& rings, int width, int height) {
    std::set<std::array<int, 3>> blocks;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            int block = 8;
            for (int k = 2; k >= 0; --k)
                if (x >= rings.left[k] && x < rings.right[k] && y >= rings.top[k] &&
                    y < rings.bottom[k])
                    block = 1 << k;
            blocks.insert({x / block * block, y / block * block, block});
        }
    return blocks.size();
}

TEST(Samples, AreOneForEachBlock) {
    const scene::Camera& view = cornell().cameras.front();
    for (const auto& edges : {std::array{3.0f, 6.0f, 12.0f}, std::array{0.0f, 0.0f, 0.0f},
                              std::array{6.0f, 6.0f, 6.0f}, std::array{0.0f, 90.0f, 90.0f}})
        for (const auto& [width, height] : {std::pair{96u, 80u}, std::pair{101u, 67u}}) {
            WeierSetup setup = rings(edges);
            setup.width = width;
            setup.height = height;
            WeierFrames frames(device(), cornell(), setup);
            const frame::Gaze behind{view.eye - view.target, 1.0f};
            for (const frame::Gaze& gaze :
                 {gaze_through(view, 48.0f, 40.0f), gaze_through(view, 3.1f, 77.0f),
                  gaze_through(view, -400.0f, 40.0f), behind}) {
                const std::uint64_t before = frames.rays(kernel::RayClass::sparse);
                frames.run(0, view, gaze);
                const std::uint64_t samples = frames.rays(kernel::RayClass::sparse) - before;
                const auto where = frames.read<shared::Rings>("rings").front();
                EXPECT_EQ(samples, blocks_in(where, int(width), int(height)));
                EXPECT_EQ(samples,
                          stage::count_blocks(frames.params, stage::make_params(setup.rings)));
            }
        }
}

// A wall that fills every view of it, of `cells` x `cells` squares of two colours, or even.
scene::Scene wall(int cells) {
    scene::Mesh mesh;
    const float side = 16.0f / float(std::max(cells, 1));
    for (int y = 0; y < std::max(cells, 1); ++y)
        for (int x = 0; x < std::max(cells, 1); ++x)
            add_quad(mesh, {-8 + float(x) * side, -8 + float(y) * side, -5}, {side, 0, 0},
                     {0, side, 0}, std::uint32_t((x + y) % 2));
    scene::Scene scene;
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back({0, {}, "wall"});
    scene.materials.resize(2);
    scene.materials[0].diffuse = scene.materials[1].diffuse = glm::vec3(0.0f);
    scene.materials[0].emission = {0.25f, 0.5f, 0.75f};
    scene.materials[1].emission = glm::vec3(cells > 0 ? 0.0f : 1.0f);
    scene.cameras.push_back({"test", {0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 80.0f});
    scene::validate(scene);
    scene.lights.clear();
    return scene;
}

TEST(Blur, KeepsAnEvenPictureForEveryGazeAndOddSize) {
    const scene::Scene scene = wall(0);
    const scene::Camera& view = scene.cameras.front();
    for (const auto& edges : {std::array{5.0f, 10.0f, 20.0f}, std::array{5.0f, 5.0f, 5.0f},
                              std::array{0.0f, 4.0f, 5.0f}}) {
        WeierSetup setup = rings(edges);
        setup.width = 91;
        setup.height = 69;
        WeierFrames frames(device(), scene, setup);
        for (const frame::Gaze& gaze :
             {gaze_through(view, 48.0f, 40.0f), gaze_through(view, 95.9f, 0.1f),
              gaze_through(view, -500.0f, 40.0f), frame::Gaze{view.eye - view.target, 1.0f}}) {
            frames.run(0, view, gaze);
            const auto colour = frames.read<float>("colour");
            for (std::size_t i = 0; i < colour.size(); i += 4) {
                ASSERT_NEAR(colour[i], 0.25f, 1e-6f) << "pixel " << i / 4;
                ASSERT_NEAR(colour[i + 1], 0.5f, 1e-6f);
                ASSERT_EQ(colour[i + 3], 1.0f);
            }
        }
    }
}

double green(const render::Image& image) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < pixels(image); ++i)
        sum += at(image, i).y;
    return sum / pixels(image);
}

TEST(Blur, ACheckerboardKeepsItsMean) {
    const scene::Scene scene = wall(64);
    const auto mean_of = [&](const char* method, std::uint32_t samples) {
        render::Options o;
        o.width = o.height = 160;
        o.method = method;
        o.samples_per_pixel = samples;
        render::Renderer renderer(device(), scene, o);
        renderer.render(0);
        return green(renderer.map("colour"));
    };
    const double expected = mean_of("full", 64);
    EXPECT_NEAR(expected, 0.25, 0.01);
    EXPECT_NEAR(mean_of("lowres_rings", 64), expected, 0.02 * expected);
}

// The steepest step between neighbours along the rows of a picture that is dark on one side.
float steepest_step(bool blur) {
    WeierSetup setup = rings({0.0f, 10.0f, 20.0f});
    setup.rings.blur = blur;
    WeierFrames frames(device(), wall(2), setup);
    const scene::Camera view{"test", {0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 80.0f};
    frames.run(0, view, gaze_through(view, -8.0f, 20.0f));
    const auto colour = frames.read<float>("colour");
    float step = 0.0f;
    for (std::size_t i = 30 * 96 + 40; i < 30 * 96 + 60; ++i)
        step = std::max(step, std::fabs(colour[4 * i + 5] - colour[4 * i + 1]));
    return step;
}

TEST(Blur, SpreadsAStepOverAsManyPixelsAsABlockHas) {
    EXPECT_EQ(steepest_step(false), 0.5f);
    EXPECT_NEAR(steepest_step(true), 0.5f / 8.0f, 1e-6f);
}

TEST(Blur, OffShowsEachBlockInOneColour) {
    WeierSetup setup = rings({5.0f, 10.0f, 20.0f});
    setup.rings.blur = false;
    WeierFrames frames(device(), cornell(), setup);
    const scene::Camera& view = cornell().cameras.front();
    frames.run(0, view, gaze_through(view, 20.0f, 20.0f));
    const auto colour = frames.read<std::uint32_t>("colour");
    const auto where = frames.read<shared::Rings>("rings").front();
    for (int y = 0; y < 80; ++y)
        for (int x = 0; x < 96; ++x) {
            const int block = shared::block_of_pixel(&where, x, y);
            const int first = y / block * block * 96 + x / block * block;
            for (int c = 0; c < 4; ++c)
                ASSERT_EQ(colour[(y * 96 + x) * 4 + c], colour[first * 4 + c]) << x << " " << y;
        }
}

std::string hash_with(render::Options options) {
    options.width = 150;
    options.height = 90;
    options.method = "lowres_rings";
    render::Renderer renderer(device(), cornell(), options);
    renderer.render(0);
    return renderer.hash();
}

TEST(Bits, AreThoseOfEveryVariantAndNumberOfLanes) {
    render::Options options;
    options.lanes = 16;
    const std::string expected = hash_with(options);
    options.lanes = 1;
    EXPECT_EQ(hash_with(options), expected);
    options.variant = "while_while";
    EXPECT_EQ(hash_with(options), expected);
    options.rings.grid = true;
    const std::string grid = hash_with(options);
    EXPECT_NE(grid, expected);
    options.lanes = 16;
    EXPECT_EQ(hash_with(options), grid);
}

TEST(Options, EdgesThatDoNotAscendOrAreNoAnglesAreErrors) {
    for (const auto& edges :
         {std::array{-1.0f, 5.0f, 9.0f}, std::array{5.0f, 4.0f, 9.0f},
          std::array{5.0f, 9.0f, 181.f}, std::array{NAN, 5.0f, 9.0f}, std::array{1.0f, 5.0f, NAN}})
        EXPECT_THROW(WeierFrames(device(), cornell(), rings(edges)), std::invalid_argument);
}

} // namespace
