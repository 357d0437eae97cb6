// Which pixels method weier samples: the paper's counts, figure 3, the options' limits, the same
// choice and picture on another runtime.
#include <cmath>
#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lib/acuity.h"
#include "scenes/load.hpp"
#include "tests/support/small_scenes.hpp"
#include "tests/support/weier_frames.hpp"

namespace {
using namespace macula;
using namespace macula::test;
using frame::LightMode;
using testing::HasSubstr;
using testing::ThrowsMessage;

// PoCL shows the same CPU by two of its drivers when it is asked to before it starts.
const bool kTwoDrivers = setenv("POCL_DEVICES", "pthread basic", 0) == 0;

compute::Device& device() {
    static compute::Device opened = compute::open();
    return opened;
}

// The left eye of the DK2 (Weier et al. 2016, section 4.1), looking at a wall without detail.
WeierSetup dk2() {
    WeierSetup setup;
    setup.width = 1182;
    setup.height = 1464;
    setup.tangents = frame::Tangents{1.0586f, 1.0924f, 1.3299f, 1.3299f};
    setup.outputs = {"sampling", "list length"};
    // So that one frame shows what the foveal function and the support grid choose by themselves.
    setup.weier.first_frame_full = false;
    return setup;
}

const scene::Scene& wall() {
    static const scene::Scene made = [] {
        scene::Mesh mesh;
        add_quad(mesh, {-90, -90, -5}, {180, 0, 0}, {0, 180, 0});
        return scene_of(std::move(mesh), {{0, 0, 0}, {0, 0, -1}, 80.0f});
    }();
    return made;
}

double part_sampled(WeierFrames& frames, const WeierSetup& setup) {
    return double(frames.read<std::uint32_t>("list length")[0]) / (setup.width * setup.height);
}

double eccentricity(const shared::FrameParams& p, std::uint32_t x, std::uint32_t y) {
    const auto& c = p.camera;
    const double sx = (x + 0.5) * (c.tan_left + c.tan_right) / p.width - c.tan_left;
    const double sy = c.tan_up - (y + 0.5) * (c.tan_up + c.tan_down) / p.height;
    double along = 0.0;
    for (int k = 0; k < 3; ++k)
        along += p.gaze[k] * (c.right[k] * sx + c.up[k] * sy + c.forward[k]);
    const double cosine = std::min(along / std::sqrt(1.0 + sx * sx + sy * sy), 1.0);
    return std::acos(cosine) * 180.0 / std::numbers::pi;
}

TEST(Dk2, TheSupportImageHasThePapersSize) {
    const shared::WeierParams p = stage::make_params(stage::WeierOptions{}, 1182, 1464);
    EXPECT_EQ(p.support_width, 256u);
    EXPECT_EQ(p.support_height, 318u);
}

TEST(Dk2, MediumSamplesThePapersPartOfThePixels) {
    WeierSetup setup = dk2();
    // In the first frame nothing is resampled: the foveal function and the support grid.
    WeierFrames both(device(), wall(), setup);
    both.run(0, wall().cameras.front());
    EXPECT_NEAR(part_sampled(both, setup), 0.132, 0.001);
    setup.weier.support_width = setup.weier.support_height = 2;
    WeierFrames alone(device(), wall(), setup);
    alone.run(0, wall().cameras.front());
    EXPECT_NEAR(part_sampled(alone, setup), 0.089, 0.001);
}

TEST(Dk2, TheSecondFrameIsSparseAgain) {
    WeierSetup setup = dk2();
    setup.weier.first_frame_full = true;
    WeierFrames frames(device(), wall(), setup);
    frames.run(0, wall().cameras.front());
    EXPECT_EQ(part_sampled(frames, setup), 1.0);
    frames.run(1, wall().cameras.front());
    EXPECT_NEAR(part_sampled(frames, setup), 0.132, 0.001);
}

TEST(Dk2, TheProbabilityFollowsFigure3) {
    WeierSetup setup = dk2();
    setup.weier.support_width = setup.weier.support_height = 2;
    WeierFrames frames(device(), wall(), setup);
    // Off the middle: eccentricity is an angle to the gaze, not a distance on the image.
    frame::Gaze gaze;
    gaze.direction = glm::vec3(0.2f, -0.15f, -1.0f);
    frames.run(3, wall().cameras.front(), gaze);
    const auto sampling = frames.read<std::uint32_t>("sampling");
    std::vector<double> pixels(60), sampled(60), expected(60);
    for (std::uint32_t i = 0; i < sampling.size(); ++i) {
        const double e = eccentricity(frames.params, i % setup.width, i / setup.width);
        const auto bin = std::min(std::size_t(e), std::size_t{59});
        pixels[bin] += 1.0;
        sampled[bin] += sampling[i] != 0 ? 1.0 : 0.0;
        expected[bin] += e <= 10.0 ? 1.0 : (e >= 20.0 ? 0.05 : 1.0 - 0.95 * (e - 10.0) / 10.0);
    }
    for (std::size_t bin = 0; bin < 60; ++bin) {
        // Four standard deviations of a binomial count, and a pixel at each end of the bin.
        const double p = expected[bin] / pixels[bin];
        EXPECT_NEAR(sampled[bin], expected[bin], 4.0 * std::sqrt(pixels[bin] * p * (1 - p)) + 2.0)
            << bin << " degrees";
    }
}

TEST(FovealFunction, HasTheEndsOfFigure3) {
    using shared::foveal_probability;
    EXPECT_EQ(foveal_probability(0.0f, 10.0f, 20.0f, 0.05f), 1.0f);
    EXPECT_EQ(foveal_probability(10.0f, 10.0f, 20.0f, 0.05f), 1.0f);
    EXPECT_FLOAT_EQ(foveal_probability(15.0f, 10.0f, 20.0f, 0.05f), 0.525f);
    EXPECT_EQ(foveal_probability(20.0f, 10.0f, 20.0f, 0.05f), 0.05f);
    EXPECT_EQ(foveal_probability(170.0f, 10.0f, 20.0f, 0.05f), 0.05f);
    EXPECT_EQ(foveal_probability(10.1f, 10.0f, 10.0f, 0.05f), 0.05f); // a step
}

TEST(Gaze, AWidenedRegionSamplesMore) {
    WeierSetup setup = dk2();
    setup.width = 300;
    setup.height = 370;
    WeierFrames frames(device(), wall(), setup);
    frames.run(0, wall().cameras.front());
    const double narrow = part_sampled(frames, setup);
    frame::Gaze unsure;
    unsure.widening = 1.5f;
    frames.run(1, wall().cameras.front(), unsure);
    EXPECT_GT(part_sampled(frames, setup), 1.3 * narrow);
}

TEST(Options, OutOfRangeAreNamed) {
    const auto refused = [](auto change) {
        return [change] {
            stage::WeierOptions o;
            change(o);
            stage::make_params(o, 64, 64);
        };
    };
    using O = stage::WeierOptions;
    const auto named = [](const char* text) {
        return ThrowsMessage<std::invalid_argument>(HasSubstr(text));
    };
    EXPECT_THAT(refused([](O& o) { o.r0 = 30.0f; }), named("r0 <= r1"));
    EXPECT_THAT(refused([](O& o) { o.r1 = NAN; }), named("r0 <= r1"));
    EXPECT_THAT(refused([](O& o) { o.p_min = 1.5f; }), named("p_min"));
    EXPECT_THAT(refused([](O& o) { o.k_min = 0.0f; }), named("k_min"));
    EXPECT_THAT(refused([](O& o) { o.t_max = 1; }), named("t_max"));
    EXPECT_THAT(refused([](O& o) { o.support_width = 5000; }), named("support"));
    EXPECT_THAT(refused([](O& o) { o.filter_window = 0; }), named("window"));
    EXPECT_THROW(stage::make_params(stage::WeierOptions{}, 1, 1), std::invalid_argument);
}

// Sizes that no tile, no cell and no packet divides.
TEST(OddSizes, AreSampledAndFilledToTheLastPixel) {
    const scene::Scene cornell = scene::load("cornell");
    for (const auto& [width, height] : {std::pair{2u, 2u}, {3u, 70u}, {65u, 33u}, {97u, 31u}}) {
        WeierSetup setup;
        setup.width = width;
        setup.height = height;
        setup.outputs = {"sampling", "list length"};
        WeierFrames frames(device(), cornell, setup);
        for (std::uint32_t frame = 0; frame < 3; ++frame) {
            frames.run(frame, cornell.cameras.front());
            std::uint32_t sampled = 0;
            for (const std::uint32_t s : frames.read<std::uint32_t>("sampling"))
                sampled += s != 0 ? 1 : 0;
            EXPECT_EQ(frames.read<std::uint32_t>("list length")[0], sampled);
            for (const float value : frames.read<float>("colour"))
                ASSERT_TRUE(std::isfinite(value));
        }
    }
}

class EachMode : public testing::TestWithParam<LightMode> {};

TEST_P(EachMode, TwoRuntimesGiveTheSameBits) {
    ASSERT_TRUE(kTwoDrivers);
    std::optional<compute::Device> basic;
    for (const auto& facts : compute::enumerate())
        if (facts.name.find("basic") != std::string::npos)
            basic = compute::open(std::to_string(facts.index));
    if (!basic)
        GTEST_SKIP() << "PoCL's driver \"basic\" is not there";
    const scene::Scene scene = scene::load("tunnel_geometry");
    WeierSetup setup;
    setup.width = 150;
    setup.height = 130;
    setup.lights = GetParam();
    setup.samples = 2;
    setup.outputs = {"cache info"};
    WeierFrames one(device(), scene, setup), other(*basic, scene, setup);
    for (std::uint32_t frame = 0; frame < 5; ++frame) {
        const scene::Camera view = frame::camera_on_path(scene, 10 + 3 * frame);
        one.run(frame, view);
        other.run(frame, view);
        EXPECT_EQ(one.read<std::uint32_t>("colour"), other.read<std::uint32_t>("colour")) << frame;
        EXPECT_EQ(one.read<std::uint32_t>("cache info"), other.read<std::uint32_t>("cache info"));
    }
}

INSTANTIATE_TEST_SUITE_P(Lights, EachMode,
                         testing::Values(LightMode::point, LightMode::area, LightMode::soft,
                                         LightMode::ambient_occlusion),
                         [](const auto& mode) { return std::string(frame::name(mode.param)); });

} // namespace
