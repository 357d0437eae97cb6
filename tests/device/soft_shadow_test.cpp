// Soft shadows from few rays of blue noise: the penumbra of an edge against a quadrature, how its
// noise is spread over the picture, and that all ways to run the kernels agree.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "host/cl/device.hpp"
#include "scenes/load.hpp"
#include "tests/support/small_scenes.hpp"

namespace {
using namespace macula;
using namespace macula::test;

constexpr std::uint32_t kSize = 96;
constexpr float kAngle = 10.0f; // degrees: the penumbra is some 60 pixels wide

compute::Device& device() {
    static compute::Device opened = compute::open();
    return opened;
}

// A floor y = 0 under a roof y = 1 that ends at x = 0, seen from between them; the sun is overhead.
scene::Scene half_roof() {
    scene::Mesh mesh;
    add_quad(mesh, {-50, 0, -50}, {0, 0, 100}, {100, 0, 0});
    add_quad(mesh, {-50, 1, -50}, {0, 0, 100}, {50, 0, 0});
    scene::Scene scene = scene_of(std::move(mesh), {{0, 0.5f, 0}, {0, 0, 0}});
    scene.lights.emplace_back();
    scene.lights[0].kind = scene::LightKind::directional;
    scene.lights[0].direction = {0, -1, 0};
    scene.lights[0].angle = kAngle;
    return scene;
}

// The irradiance at x on that floor by a quadrature over the sun's cone.
class Penumbra {
  public:
    Penumbra() {
        constexpr int rings = 200, turns = 400;
        const double height = 1.0 - std::cos(kAngle * std::numbers::pi / 180.0);
        for (int i = 0; i < rings; ++i)
            for (int j = 0; j < turns; ++j) {
                const double y = 1.0 - height * (i + 0.5) / rings;
                const double turn = 2.0 * std::numbers::pi * (j + 0.5) / turns;
                rays_.push_back({std::cos(turn) * std::sqrt(1.0 - y * y) / y, y});
            }
        std::sort(rays_.begin(), rays_.end(), [](auto& a, auto& b) { return a.slope > b.slope; });
        double sum = 0.0;
        for (Ray& ray : rays_)
            ray.sum = sum += ray.sum;
    }
    double at(double x) const {
        const auto end = std::partition_point(rays_.begin(), rays_.end(),
                                              [&](const Ray& ray) { return ray.slope > -x; });
        return end == rays_.begin() ? 0.0 : (end - 1)->sum / rays_.back().sum;
    }

  private:
    struct Ray {
        double slope, sum; // x / y; of the cosines up to this one
    };
    std::vector<Ray> rays_;
};

// Irradiance minus what it should be, of the pixels of one frame.
std::vector<double> errors(std::uint32_t samples_per_pixel, std::uint32_t frame = 0) {
    static const Penumbra penumbra;
    render::Options o;
    o.width = o.height = kSize;
    o.lights = frame::LightMode::soft;
    o.samples_per_pixel = samples_per_pixel;
    o.images = {"irradiance", "position"};
    render::Renderer renderer(device(), half_roof(), o);
    renderer.render(frame);
    const render::Image irradiance = renderer.map("irradiance"),
                        position = renderer.map("position");
    std::vector<double> out;
    for (std::uint32_t i = 0; i < pixels(irradiance); ++i) {
        EXPECT_NEAR(at(position, i).y, 0.0, 1e-5);
        out.push_back(at(irradiance, i).x - penumbra.at(at(position, i).x));
    }
    return out;
}

double mean_square(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values)
        sum += value * value;
    return sum / double(values.size());
}

// Means over blocks of `side` x `side` pixels.
std::vector<double> block_means(const std::vector<double>& values, std::uint32_t side) {
    const std::uint32_t across = kSize / side;
    std::vector<double> means(std::size_t{across} * across);
    for (std::uint32_t i = 0; i < values.size(); ++i)
        means[i / kSize / side * across + i % kSize / side] += values[i] / (side * side);
    return means;
}

TEST(Penumbra, HasTheRightMeanFromThreeRays) {
    Deviation deviation;
    for (const double error : errors(1))
        deviation.add(error);
    EXPECT_NEAR(deviation.mean(), 0.0, 4.0 * deviation.standard_error());
    // Three independent rays would err by up to 0.29 in the middle of it.
    EXPECT_LT(std::sqrt(deviation.squares / deviation.count), 0.2);
}

TEST(Penumbra, ConvergesAtEveryPixelWithItsSamples) {
    // 108 rays: independent ones would err by 0.03 in the mean square and by 0.18 somewhere.
    const std::vector<double> found = errors(36);
    EXPECT_LT(std::sqrt(mean_square(found)), 0.012);
    for (const double error : found)
        ASSERT_LT(std::fabs(error), 0.06);
}

TEST(Penumbra, ItsNoiseIsGoneFromAfar) {
    // White noise loses a factor of 64 in blocks of 8 x 8.
    const std::vector<double> found = errors(1);
    EXPECT_LT(mean_square(block_means(found, 8)), 0.55 * mean_square(found) / 64.0);
}

TEST(Penumbra, ItsNoiseIsGoneFromTheMeanOfItsFrames) {
    std::vector<double> sum(std::size_t{kSize} * kSize);
    double one = 0.0;
    for (std::uint32_t frame = 0; frame < 16; ++frame) {
        const std::vector<double> found = errors(1, frame);
        one += mean_square(found) / 16.0;
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += found[i] / 16.0;
    }
    // White noise would lose a factor of 16.
    EXPECT_LT(mean_square(sum), 0.65 * one / 16.0);
}

TEST(SoftLights, HaveTheSameBitsInOneAndSixteenLanes) {
    for (const char* method : {"full", "weier", "logpolar", "logrect", "lowres"}) {
        std::vector<std::string> hashes;
        for (const std::uint32_t lanes : {1u, 16u}) {
            render::Options o;
            o.width = 70;
            o.height = 50;
            o.method = method;
            o.lights = frame::LightMode::soft;
            o.lanes = lanes;
            render::Renderer renderer(device(), scene::load("cornell"), o);
            renderer.render(0);
            renderer.render(20);
            hashes.push_back(renderer.hash());
        }
        EXPECT_EQ(hashes[0], hashes[1]) << method;
    }
}

TEST(SoftLights, TakeThreeRaysUnlessMoreAreAskedFor) {
    render::Options o;
    o.width = o.height = 32;
    o.lights = frame::LightMode::soft;
    render::Renderer three(device(), half_roof(), o);
    o.light_samples = 7;
    render::Renderer seven(device(), half_roof(), o);
    const auto shadow = static_cast<std::size_t>(kernel::RayClass::shadow);
    EXPECT_EQ(three.render(0).rays[shadow], 3u * 32 * 32);
    EXPECT_EQ(seven.render(0).rays[shadow], 7u * 32 * 32);
}

} // namespace
