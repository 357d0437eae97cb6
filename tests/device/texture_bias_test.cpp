// Which level of its texture a surface shows, against levels reckoned by hand.
#include <cmath>

#include <gtest/gtest.h>

#include "host/frame/frame_params.hpp"
#include "lib/log_polar.h"
#include "tests/support/small_scenes.hpp"
#include "tests/support/weier_frames.hpp"

namespace {
using namespace macula;
using namespace macula::test;

constexpr int kLevels = 9; // of 256 texels
constexpr float kDepth = 5.0f, kHalf = 5.0f;

compute::Device& device() {
    static compute::Device opened = compute::open();
    return opened;
}

// A wall that faces the eye; its texture covers it once, and each level has one brightness: 20
// times its number, of 255.
scene::Scene wall() {
    scene::Mesh mesh;
    add_quad(mesh, {-kHalf, -kHalf, -kDepth}, {2 * kHalf, 0, 0}, {0, 2 * kHalf, 0});
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    scene::Scene scene = scene_of(std::move(mesh), {{0, 0, 0}, {0, 0, -1}, 60.0f});
    scene::Texture texture;
    texture.srgb = false;
    for (int level = 0; level < kLevels; ++level) {
        const auto side = static_cast<std::uint32_t>(256 >> level);
        texture.levels.push_back({side, side, {}});
        texture.levels.back().rgba.assign(std::size_t{4} * side * side,
                                          static_cast<std::uint8_t>(20 * level));
    }
    scene.textures = {texture};
    scene.materials[0].diffuse = glm::vec3(0.0f);
    scene.materials[0].emission = glm::vec3(1.0f);
    scene.materials[0].emission_texture = 0;
    return scene;
}

double level_of(float brightness) {
    return brightness * 255.0 / 20.0;
}

// log2 of the texels across a pixel of a picture 96 high, at the middle of the wall.
double level_of_a_pixel() {
    const double pixel = 2.0 * std::tan(30.0 * std::numbers::pi / 180.0) * kDepth / 80.0;
    return std::log2(pixel * 256.0 / (2.0 * kHalf));
}

double middle_level(render::Options o) {
    o.width = 96;
    o.height = 80;
    render::Renderer renderer(device(), wall(), o);
    renderer.render(0);
    return level_of(float(at(renderer.map("colour"), 40 * 96 + 48).x));
}

TEST(TextureBias, AddsItsLevels) {
    EXPECT_NEAR(middle_level({}), std::max(level_of_a_pixel(), 0.0), 0.02);
    for (const float bias : {1.0f, 2.5f, 5.0f}) {
        render::Options o;
        o.lod_bias = bias;
        EXPECT_NEAR(middle_level(o), level_of_a_pixel() + bias, 0.02) << bias;
    }
    render::Options o;
    o.lod_bias = -16.0f;
    EXPECT_EQ(middle_level(o), 0.0) << "the finest level";
    o.lod_bias = 16.0f;
    EXPECT_NEAR(middle_level(o), kLevels - 1.0, 1e-4) << "the coarsest";
}

TEST(TextureBias, OutOfRangeIsAnError) {
    for (const float bad : {16.5f, -17.0f, NAN}) {
        render::Options o;
        o.lod_bias = bad;
        EXPECT_THROW(middle_level(o), std::invalid_argument);
    }
    EXPECT_THROW(stage::parse_lod_rule("pixel"), std::invalid_argument);
}

// Section 4.1.2: what is foveated must not be sharpened.
TEST(TextureBias, BelowZeroIsRefusedWhereverAMethodFoveates) {
    std::size_t refused = 0;
    for (const method::Method& method : method::methods()) {
        render::Options o;
        o.method = method.name;
        o.lod_bias = -0.5f;
        const bool allowed = o.method.starts_with("full") || o.method == "lowres";
        if (allowed)
            EXPECT_NO_THROW(middle_level(o)) << o.method;
        else
            EXPECT_THROW(middle_level(o), std::invalid_argument) << o.method;
        refused += allowed ? 0 : 1;
    }
    EXPECT_GE(refused, 12u);
}

double phi(double u, double alpha) {
    const double t = std::pow(u, alpha), step = t * t * (3.0 - 2.0 * t);
    return 3.0 * std::pow(step, 3.0);
}

TEST(ThesisLod, IsEquations42And43) {
    for (const float alpha : {1.0f, 4.0f}) {
        shared::LogPolarParams p{};
        p.width = 1067;
        p.alpha = alpha;
        for (const float column : {0.0f, 100.5f, 700.25f, 1000.0f, 1067.0f}) {
            const double b = 0.3 + phi(column / 1067.0, alpha);
            EXPECT_NEAR(std::log2(shared::log_polar_thesis_spread(&p, column)), b, 1e-5);
        }
    }
}

TEST(ThesisLod, IsWhatSamplesOfTheBufferAreFilteredFor) {
    WeierSetup setup;
    setup.method = "logpolar";
    setup.log_polar.lod = stage::LodRule::thesis;
    setup.outputs = {"spread of slot", "pixel of slot", "ray count"};
    const scene::Scene scene = wall();
    WeierFrames frames(device(), scene, setup);
    frames.run(0, scene.cameras.front());
    const auto spreads = frames.read<float>("spread of slot");
    const auto places = frames.read<std::uint32_t>("pixel of slot");
    const std::uint32_t width = 53, pitch = width + 2; // 96 / 1.8
    int disk = 0, texels = 0;
    for (std::uint32_t i = 0; i < frames.read<std::uint32_t>("ray count")[0]; ++i) {
        if (places[i] == ~0u)
            continue;
        const bool beyond = places[i] >= 96 * 80;
        const double u = beyond ? ((places[i] - 96 * 80) % pitch - 0.5) / width : 0.0;
        EXPECT_NEAR(std::log2(spreads[i]), 0.3 + phi(u, 4.0), 1e-4);
        ++(beyond ? texels : disk);
    }
    EXPECT_GT(disk, 100);
    EXPECT_GT(texels, 100);
}

TEST(ThesisLod, BlursTowardsThePeriphery) {
    render::Options o;
    o.width = 96;
    o.height = 80;
    o.method = "logpolar";
    o.log_polar.lod = stage::LodRule::thesis;
    render::Renderer renderer(device(), wall(), o);
    renderer.render(0);
    const render::Image colour = renderer.map("colour");
    EXPECT_NEAR(level_of(float(at(colour, 40 * 96 + 48).x)), level_of_a_pixel() + 0.3, 0.02);
    EXPECT_GT(level_of(float(at(colour, 0).x)), level_of_a_pixel() + 2.0);
}

} // namespace
