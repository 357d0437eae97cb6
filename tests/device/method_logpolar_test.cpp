// Method logpolar: where it is `full`, how many samples it takes, and that nothing else gets in.
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

WeierSetup logpolar(float alpha, float sigma, float disk) {
    WeierSetup setup;
    setup.method = "logpolar";
    setup.log_polar = {.alpha = alpha, .sigma = sigma, .disk = disk};
    return setup;
}

class EachMode : public testing::TestWithParam<LightMode> {};

TEST_P(EachMode, ADiskOverTheWholeImageIsMethodFullBitForBit) {
    WeierSetup setup = logpolar(1.0f, 1.0f, 3.0f);
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
                                         LightMode::ambient_occlusion));

// Equation 5.1 in double precision: the disk's pixels, and the texels beyond the columns that lie
// in it but for its faded edge, and two more for the filter. The thesis counts all of these texels;
// those that do not reach into the image are left out.
struct Prediction {
    double disk = 0.0, texels = 0.0, texels_in_image = 0.0;
};

Prediction predict(const WeierSetup& setup, double x, double y) {
    const stage::LogPolarOptions& o = setup.log_polar;
    const double width = std::lround(96 / o.sigma), height = std::lround(80 / o.sigma);
    const double far = std::log1p(std::hypot(std::max(x, 96.0 - x), std::max(y, 80.0 - y)));
    const double radius = o.disk * 0.5 * std::hypot(96.0, 80.0);
    const double inner = std::log1p(radius * (1.0 - o.fade)) / far; // equation 4.5
    const double first_column =
        std::max(std::floor(std::pow(std::min(inner, 1.0), 1.0 / o.alpha) * width - 2.0), 0.0);
    Prediction sum;
    for (double py = 0.5; py < 80.0; ++py)
        for (double px = 0.5; px < 96.0; ++px)
            sum.disk += std::hypot(px - x, py - y) < radius ? 1.0 : 0.0;
    for (double column = first_column + 0.5; column < width; ++column)
        for (double row = 0.5; row < height; ++row) {
            const double t = column / width, turn = 2.0 * std::numbers::pi * row / height;
            const double r = std::expm1(far * std::pow(t, o.alpha));
            const double along = (r + 1.0) * far * o.alpha * std::pow(t, o.alpha - 1.0) / width;
            const double reach = 0.6 * std::hypot(along, 2.0 * std::numbers::pi * r / height);
            const double px = x + r * std::cos(turn), py = y + r * std::sin(turn);
            const bool in = px >= -reach && py >= -reach && px < 96.0 + reach && py < 80.0 + reach;
            sum.texels += 1.0;
            sum.texels_in_image += in ? 1.0 : 0.0;
        }
    return sum;
}

TEST(Samples, AreAsManyAsEquation51Says) {
    const scene::Camera& view = cornell().cameras.front();
    for (const float alpha : {1.0f, 2.0f, 4.0f})
        for (const auto& [sigma, disk] : {std::pair{1.2f, 0.15f}, {1.2f, 0.4f}, {1.8f, 0.7f}}) {
            WeierSetup setup = logpolar(alpha, sigma, disk);
            setup.outputs = {"fovea"};
            WeierFrames frames(device(), cornell(), setup);
            std::uint64_t before = 0;
            for (const float x : {48.0f, 20.5f, -15.0f}) {
                frames.run(0, view, gaze_through(view, x, 33.0f));
                const auto fovea = frames.read<shared::Fovea>("fovea").front();
                EXPECT_NEAR(fovea.x, x, 1e-3f);
                EXPECT_NEAR(fovea.y, 33.0f, 1e-3f);
                const std::uint64_t all = frames.rays(kernel::RayClass::sparse);
                const Prediction p = predict(setup, x, 33.0);
                const double expected = p.disk + p.texels_in_image;
                EXPECT_NEAR(double(all - before), expected, 0.01 * expected)
                    << "alpha " << alpha << ", sigma " << sigma << ", disk " << disk << ", x " << x;
                EXPECT_LT(double(all - before), p.disk + p.texels) << "none is traced in vain";
                before = all;
            }
        }
}

// A wall of one colour that fills every view of it.
scene::Scene glowing_wall() {
    scene::Mesh mesh;
    add_quad(mesh, {-4000, -4000, -5}, {8000, 0, 0}, {0, 8000, 0});
    scene::Scene scene = scene_of(std::move(mesh), {{0, 0, 0}, {0, 0, -1}, 80.0f});
    for (scene::Material& material : scene.materials) {
        material.diffuse = {0, 0, 0};
        material.emission = {0.25f, 0.5f, 0.75f};
    }
    return scene;
}

// What is even stays even save for rounding, wherever the gaze is: at a corner, far outside of the
// image, behind the eye. So each pixel has samples to read.
TEST(Remap, KeepsAnEvenPictureForEveryGaze) {
    const scene::Scene scene = glowing_wall();
    const scene::Camera& view = scene.cameras.front();
    WeierFrames frames(device(), scene, logpolar(4.0f, 1.8f, 0.15f));
    const frame::Gaze gazes[] = {gaze_through(view, 48.0f, 40.0f),
                                 gaze_through(view, 96.0f, 80.0f),
                                 gaze_through(view, -500.0f, 40.0f),
                                 gaze_through(view, 48.0f, 10000.0f),
                                 {view.eye - view.target, 1.0f}};
    for (const frame::Gaze& gaze : gazes) {
        frames.run(0, view, gaze);
        const auto colour = frames.read<float>("colour");
        for (std::size_t i = 0; i < colour.size(); i += 4) {
            ASSERT_NEAR(colour[i], 0.25f, 1e-6f) << "pixel " << i / 4;
            ASSERT_NEAR(colour[i + 1], 0.5f, 1e-6f);
            ASSERT_NEAR(colour[i + 2], 0.75f, 1e-6f);
            ASSERT_EQ(colour[i + 3], 1.0f);
        }
    }
}

double mean_green(const WeierFrames& frames) {
    const auto colour = frames.read<float>("colour");
    double sum = 0.0;
    for (std::size_t i = 1; i < colour.size(); i += 4)
        sum += colour[i];
    return 4.0 * sum / double(colour.size());
}

// From far away one texel would stand for the whole image, and its sample lie outside, where this
// wall ends: the gaze counts as one a quarter of the diagonal away.
TEST(Remap, AGazeFarOutsideOfTheImageStillShowsIt) {
    scene::Scene scene = glowing_wall();
    for (glm::vec3& p : scene.meshes[0].positions)
        p *= glm::vec3(6.0f / 4000.0f, 5.0f / 4000.0f, 1.0f);
    const scene::Camera& view = scene.cameras.front();
    WeierSetup setup = logpolar(4.0f, 1.8f, 0.15f);
    setup.outputs = {"fovea"};
    WeierFrames frames(device(), scene, setup);
    const float outside = 0.25f * std::hypot(96.0f, 80.0f) + 0.01f;
    for (const glm::vec2 at : {glm::vec2(9000, 40), {48, -9000}, {-9000, 9000}, {300, 300}}) {
        frames.run(0, view, gaze_through(view, at.x, at.y));
        const auto fovea = frames.read<shared::Fovea>("fovea").front();
        EXPECT_LT(std::abs(fovea.x - 48.0f), 48.0f + outside);
        EXPECT_LT(std::abs(fovea.y - 40.0f), 40.0f + outside);
        EXPECT_GT(mean_green(frames), 0.35) << at.x << ", " << at.y;
    }
}

// Squares of 0 and 1, a pixel and a half across. Some hundred samples are not enough for a mean:
// those of many gazes are.
TEST(Remap, ACheckerboardKeepsItsMean) {
    scene::Scene scene = glowing_wall();
    scene::Mesh& mesh = scene.meshes[0];
    scene.materials.resize(3, scene.materials[0]);
    scene.materials[0].emission = glm::vec3(0.5f);
    scene.materials[1].emission = glm::vec3(0.0f);
    scene.materials[2].emission = glm::vec3(1.0f);
    for (int j = -40; j < 40; ++j)
        for (int i = -44; i < 44; ++i)
            add_quad(mesh, {0.13f * float(i), 0.13f * float(j), -4}, {0.13f, 0, 0}, {0, 0.13f, 0},
                     std::uint32_t(1 + ((i + j) & 1)));
    const scene::Camera& view = scene.cameras.front();
    constexpr int kGazes = 48;
    for (const float alpha : {1.0f, 4.0f}) {
        WeierFrames frames(device(), scene, logpolar(alpha, 1.8f, 0.15f));
        double sum = 0.0;
        for (int i = 0; i < kGazes; ++i) {
            frames.run(0, view,
                       gaze_through(view, -5.0f + 2.23f * float(i), float((i * 37) % 80) + 0.3f));
            sum += mean_green(frames) / kGazes;
        }
        EXPECT_NEAR(sum, 0.5, 0.015) << alpha;
    }
}

TEST(Remap, OneAndSixteenLanesGiveTheSameBits) {
    // Without a disk the gaze's own pixel, in the middle of 151 x 91, is none of the disk's.
    for (const std::uint32_t odd : {0u, 1u}) {
        std::vector<std::string> hashes;
        for (const std::uint32_t lanes : {1u, 16u}) {
            render::Options options;
            options.width = 150 + odd;
            options.height = 90 + odd;
            options.method = "logpolar";
            if (odd != 0)
                options.log_polar.disk = 0.0f;
            options.lanes = lanes;
            render::Renderer renderer(device(), cornell(), options);
            renderer.render(0);
            hashes.push_back(renderer.hash());
        }
        EXPECT_EQ(hashes[0], hashes[1]) << "odd " << odd;
    }
}

TEST(Options, OutOfRangeAreErrors) {
    for (const float bad : {0.5f, 17.0f, NAN}) {
        EXPECT_THROW(WeierFrames(device(), cornell(), logpolar(bad, 1.8f, 0.15f)),
                     std::invalid_argument);
        EXPECT_THROW(WeierFrames(device(), cornell(), logpolar(4.0f, bad, 0.15f)),
                     std::invalid_argument);
    }
    EXPECT_THROW(WeierFrames(device(), cornell(), logpolar(4.0f, 1.8f, -0.1f)),
                 std::invalid_argument);
}

} // namespace
