// Method lowres: all pixels at scale 1, fewer rays below, and what a cubic keeps.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/load.hpp"
#include "tests/support/small_scenes.hpp"
#include "tests/support/weier_frames.hpp"

namespace {
using namespace macula;
using namespace macula::test;

compute::Device& device() {
    static compute::Device opened = compute::open();
    return opened;
}

WeierSetup lowres(float scale) {
    WeierSetup setup;
    setup.method = "lowres";
    setup.lowres_scale = scale;
    return setup;
}

TEST(Scale, OneIsMethodFullBitForBit) {
    const scene::Scene cornell = scene::load("cornell");
    for (const auto lights : {frame::LightMode::area, frame::LightMode::ambient_occlusion}) {
        WeierSetup setup = lowres(1.0f);
        setup.lights = lights;
        WeierFrames coarse(device(), cornell, setup);
        setup.method = "full";
        WeierFrames full(device(), cornell, setup);
        coarse.run(5, cornell.cameras.front());
        full.run(5, cornell.cameras.front());
        EXPECT_EQ(coarse.read<std::uint32_t>("colour"), full.read<std::uint32_t>("colour"));
    }
}

TEST(Scale, SetsTheNumberOfRays) {
    const scene::Scene cornell = scene::load("cornell");
    for (const float scale : {0.25f, 0.5f, 1e-6f}) {
        WeierFrames frames(device(), cornell, lowres(scale));
        frames.run(0, cornell.cameras.front());
        const std::uint64_t rays = frames.rays(kernel::RayClass::primary);
        EXPECT_EQ(rays, std::max<std::uint64_t>(std::lround(96 * scale), 1) *
                            std::max<std::uint64_t>(std::lround(80 * scale), 1));
        for (const float value : frames.read<float>("colour"))
            ASSERT_TRUE(std::isfinite(value) && value >= 0.0f);
    }
}

TEST(Scale, OutOfRangeIsAnError) {
    const scene::Scene cornell = scene::load("cornell");
    for (const float scale : {0.0f, -1.0f, 1.01f, NAN})
        EXPECT_THROW(WeierFrames(device(), cornell, lowres(scale)), std::invalid_argument);
}

TEST(Enlargement, KeepsAConstant) {
    scene::Mesh mesh;
    add_quad(mesh, {-40, -40, -5}, {80, 0, 0}, {0, 80, 0});
    scene::Scene scene = scene_of(std::move(mesh), {{0, 0, 0}, {0, 0, -1}, 80.0f});
    scene.materials[0].diffuse = glm::vec3(0.0f);
    scene.materials[0].emission = glm::vec3(0.25f, 0.5f, 1.0f);
    WeierFrames frames(device(), scene, lowres(0.37f));
    frames.run(0, scene.cameras.front());
    const auto colour = frames.read<float>("colour");
    for (std::size_t i = 0; i < colour.size(); i += 4) {
        EXPECT_NEAR(colour[i], 0.25f, 1e-6f);
        EXPECT_NEAR(colour[i + 1], 0.5f, 1e-6f);
        EXPECT_NEAR(colour[i + 2], 1.0f, 2e-6f);
    }
}

} // namespace
