// Method logrect: where it is `full`, what it keeps, and that nothing else gets in.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

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

WeierSetup logrect(float alpha, float sigma, float disk) {
    WeierSetup setup;
    setup.method = "logrect";
    setup.log_polar = {.sigma = sigma, .disk = disk, .rect_alpha = alpha};
    return setup;
}

class EachMode : public testing::TestWithParam<LightMode> {};

TEST_P(EachMode, ADiskOverTheWholeImageIsMethodFullBitForBit) {
    WeierSetup setup = logrect(4.0f, 1.8f, 3.0f);
    setup.lights = GetParam();
    WeierFrames foveated(device(), cornell(), setup);
    setup.method = "full";
    WeierFrames full(device(), cornell(), setup);
    const scene::Camera& view = cornell().cameras.front();
    for (const float x : {48.0f, 3.0f, -20.0f}) {
        foveated.run(5, view, gaze_through(view, x, 30.0f));
        full.run(5, view);
        EXPECT_EQ(foveated.read<std::uint32_t>("colour"), full.read<std::uint32_t>("colour"));
    }
}

INSTANTIATE_TEST_SUITE_P(Lights, EachMode,
                         testing::Values(LightMode::point, LightMode::area, LightMode::soft,
                                         LightMode::ambient_occlusion),
                         [](const auto& mode) { return std::string(frame::name(mode.param)); });

// Without a disk everything passes through the buffer.
TEST(OneTexelAPixel, IsMethodFullToRounding) {
    WeierFrames foveated(device(), cornell(), logrect(4.0f, 1.0f, 0.0f));
    WeierSetup setup;
    setup.method = "full";
    WeierFrames full(device(), cornell(), setup);
    const scene::Camera& view = cornell().cameras.front();
    for (const float x : {48.0f, 20.3f, 200.0f}) {
        foveated.run(0, view, gaze_through(view, x, 33.7f));
        full.run(0, view);
        const auto found = foveated.read<float>("colour"), expected = full.read<float>("colour");
        int off = 0;
        for (std::size_t i = 0; i < found.size(); ++i)
            off += std::fabs(found[i] - expected[i]) > 1e-3f ? 1 : 0;
        // A ray that is off by a rounding may pass an edge on its other side.
        EXPECT_LT(off, 12) << "gaze at " << x;
    }
}

TEST(Samples, AreTheBuffersTexelsAndTheDisk) {
    const scene::Camera& view = cornell().cameras.front();
    for (const float sigma : {1.8f, 4.0f}) {
        WeierFrames frames(device(), cornell(), logrect(4.0f, sigma, 0.15f));
        std::uint64_t before = 0;
        for (const float x : {48.0f, 7.0f, -3000.0f}) {
            frames.run(0, view, gaze_through(view, x, 33.0f));
            const std::uint64_t all = frames.rays(kernel::RayClass::sparse);
            const double texels = std::lround(96 / sigma) * double(std::lround(80 / sigma));
            const double radius = 0.15 * 0.5 * std::hypot(96.0, 80.0);
            const double disk = std::numbers::pi * radius * radius;
            EXPECT_LE(double(all - before), texels + (x > 0.0f ? disk + 20.0 : 0.0));
            EXPECT_GE(double(all - before), texels - disk);
            before = all;
        }
    }
}

// Whatever the disk, the list holds all that is to be traced.
TEST(Samples, FitIntoTheList) {
    const scene::Camera& view = cornell().cameras.front();
    for (const float sigma : {1.0f, 1.1f, 1.8f})
        for (const float disk : {0.1f, 0.5f, 0.8f, 0.95f}) {
            WeierFrames frames(device(), cornell(), logrect(4.0f, sigma, disk));
            std::uint64_t before = 0;
            for (const float x : {48.0f, 0.0f}) {
                frames.run(0, view, gaze_through(view, x, 40.0f));
                const std::uint64_t all = frames.rays(kernel::RayClass::sparse);
                EXPECT_LE(all - before, 96u * 80u) << "sigma " << sigma << ", disk " << disk;
                before = all;
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

TEST(Remap, KeepsAnEvenPictureForEveryGaze) {
    const scene::Scene scene = wall(0);
    const scene::Camera& view = scene.cameras.front();
    for (const float sigma : {1.0f, 1.8f, 5.0f}) {
        WeierFrames frames(device(), scene, logrect(4.0f, sigma, 0.15f));
        const frame::Gaze gazes[] = {
            gaze_through(view, 48.0f, 40.0f),    gaze_through(view, 95.9f, 0.1f),
            gaze_through(view, 96.0f, 80.0f),    gaze_through(view, -500.0f, 40.0f),
            gaze_through(view, 48.0f, 10000.0f), {view.eye - view.target, 1.0f}};
        for (const frame::Gaze& gaze : gazes) {
            frames.run(0, view, gaze);
            const auto colour = frames.read<float>("colour");
            for (std::size_t i = 0; i < colour.size(); i += 4) {
                ASSERT_NEAR(colour[i], 0.25f, 1e-6f) << "pixel " << i / 4 << ", sigma " << sigma;
                ASSERT_NEAR(colour[i + 1], 0.5f, 1e-6f);
                ASSERT_EQ(colour[i + 3], 1.0f);
            }
        }
    }
}

TEST(Remap, ACheckerboardKeepsItsMean) {
    const scene::Scene scene = wall(64);
    const auto mean_of = [&](const char* method, std::uint32_t samples) {
        render::Options o;
        o.width = 160;
        o.height = 160;
        o.method = method;
        o.samples_per_pixel = samples;
        o.log_polar.sigma = 3.0f;
        render::Renderer renderer(device(), scene, o);
        renderer.render(0);
        const render::Image colour = renderer.map("colour");
        double sum = 0.0;
        for (std::uint32_t i = 0; i < pixels(colour); ++i)
            sum += at(colour, i).y;
        return sum / pixels(colour);
    };
    const double expected = mean_of("full", 64);
    EXPECT_NEAR(expected, 0.25, 0.01);
    EXPECT_NEAR(mean_of("logrect", 16), expected, 0.02 * expected);
}

TEST(Remap, OneAndSixteenLanesGiveTheSameBits) {
    std::vector<std::string> hashes;
    for (const std::uint32_t lanes : {1u, 16u}) {
        render::Options options;
        options.width = 150;
        options.height = 90;
        options.method = "logrect";
        options.lanes = lanes;
        render::Renderer renderer(device(), cornell(), options);
        renderer.render(0);
        hashes.push_back(renderer.hash());
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(Options, OutOfRangeAreErrors) {
    for (const float bad : {0.5f, 17.0f, NAN})
        EXPECT_THROW(WeierFrames(device(), cornell(), logrect(bad, 1.8f, 0.15f)),
                     std::invalid_argument);
}

} // namespace
