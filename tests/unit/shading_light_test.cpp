// Light samples against closed forms of irradiance, and Phong's lobe.
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "host/frame/blue_noise.hpp"
#include "host/frame/lights.hpp"
#include "lib/light.h"
#include "lib/phong.h"

namespace {
using namespace macula;
using shared::float3;
using shared::Light;

double dot(float3 a, float3 b) {
    return double{a.x} * b.x + double{a.y} * b.y + double{a.z} * b.z;
}

constexpr shared::uint kPixelsOfSlice = MACULA_NOISE_SIDE * MACULA_NOISE_SIDE;

struct Estimate {
    double mean, standard_error;
};

// Irradiance of a surface at `from` with normal n under a light of colour 1, over many pixels with
// the light's own strata; the error is that of the mean over pixels.
Estimate irradiance(const Light& light, float3 from, float3 n, int pixels) {
    double sum = 0, squares = 0;
    shared::FrameParams frame{};
    frame.samples_per_pixel = 1;
    for (int pixel = 0; pixel < pixels; ++pixel) {
        const auto place = static_cast<shared::uint>(pixel);
        const shared::uint key = shared::random_key(place, 0, 0);
        const std::vector<std::uint32_t>& noise = frame::blue_noise();
        frame.frame = place / kPixelsOfSlice;
        const shared::uint texel =
            noise[shared::noise_texel(place % 64, place / 64, frame.frame, 0)];
        const auto draw = shared::make_light_draw(&light, &frame, 0, 16, key, texel);
        double one = 0;
        for (shared::uint i = 0; i < light.samples; ++i) {
            shared::LightSample s{};
            shared::sample_light(&light, &draw, from, i, &s);
            const double cosine = dot(n, s.unit_direction);
            if (s.t_max > 0.0f && cosine > 0.0)
                one += double{s.weight} * cosine / light.samples;
        }
        sum += one;
        squares += one * one;
    }
    const double mean = sum / pixels;
    const double variance = std::max(squares / pixels - mean * mean, 0.0);
    return {mean, std::sqrt(variance / pixels)};
}

scene::Scene scene_with(const scene::Light& light) {
    scene::Scene scene;
    scene.lights = {light};
    return scene;
}

Light make(const scene::Light& light, frame::LightMode mode, std::uint32_t samples) {
    return frame::make_lights(scene_with(light), mode, samples).at(0);
}

scene::Light rectangle() {
    scene::Light light;
    light.kind = scene::LightKind::rectangle;
    light.position = {0.4f, 2.0f, -0.3f};
    light.edge_u = {1.5f, 0.2f, 0.0f};
    light.edge_v = {0.0f, 0.1f, 2.5f};
    light.attenuation_distance = 1.0f;
    return light;
}

// Lambert's formula: the irradiance of a polygon of radiance 1 entirely above the horizon.
double lambert(const std::array<float3, 4>& corners, float3 from, float3 n) {
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const float3 a = corners[i] - from, b = corners[(i + 1) % 4] - from;
        const double ax = a.x, ay = a.y, az = a.z, bx = b.x, by = b.y, bz = b.z;
        const double cx = ay * bz - az * by, cy = az * bx - ax * bz, cz = ax * by - ay * bx;
        const double size = std::sqrt(cx * cx + cy * cy + cz * cz);
        const double angle = std::atan2(size, dot(a, b));
        sum += angle * (n.x * cx + n.y * cy + n.z * cz) / size;
    }
    return std::fabs(sum) / 2.0;
}

TEST(RectangleLight, GivesLambertsIrradiance) {
    const scene::Light source = rectangle();
    const Light light = make(source, frame::LightMode::area, 64);
    const auto corner = [&](float u, float v) {
        const glm::vec3 p = source.position + u * source.edge_u + v * source.edge_v;
        return float3{p.x, p.y, p.z};
    };
    const std::array<float3, 4> corners{corner(-0.5f, -0.5f), corner(0.5f, -0.5f),
                                        corner(0.5f, 0.5f), corner(-0.5f, 0.5f)};
    const float3 up = {0, 1, 0};
    const double area = glm::length(glm::cross(source.edge_u, source.edge_v));
    for (const float3 from : {float3{0, 0, 0}, float3{3, 0, 1}, float3{0.4f, 1.5f, -0.3f}}) {
        const Estimate e = irradiance(light, from, up, 4000);
        // Intensity 1 along the normal is radiance 1 / area.
        EXPECT_NEAR(e.mean, lambert(corners, from, up) / area, 5.0 * e.standard_error + 1e-6);
        EXPECT_LT(e.standard_error, 0.01 * e.mean);
    }
}

TEST(RectangleLight, SendsNothingBackwards) {
    const Light light = make(rectangle(), frame::LightMode::area, 16);
    EXPECT_EQ(irradiance(light, {0, 5, 0}, {0, -1, 0}, 10).mean, 0.0);
}

TEST(RectangleLight, ShrinksToAPointOfTheSameIntensity) {
    scene::Light small = rectangle();
    small.edge_u *= 0.001f;
    small.edge_v *= 0.001f;
    const float3 from = {1, 0, 1}, up = {0, 1, 0};
    const Estimate area = irradiance(make(small, frame::LightMode::area, 8), from, up, 50);
    const Estimate point = irradiance(make(small, frame::LightMode::point, 8), from, up, 1);
    EXPECT_NEAR(area.mean, point.mean, 5.0 * area.standard_error + 1e-6 * point.mean);
}

TEST(SphereLight, GivesTheInverseSquareOfItsCentreAtAnyDistance) {
    scene::Light source;
    source.kind = scene::LightKind::spherical;
    source.position = {0, 3, 0};
    source.radius = 1.0f;
    source.attenuation_distance = 1.0f;
    const Light light = make(source, frame::LightMode::area, 64);
    for (const float3 from : {float3{0, 0, 0}, float3{0, 1.5f, 0}, float3{2, 0.5f, 1}}) {
        const Estimate e = irradiance(light, from, {0, 1, 0}, 4000);
        const float3 d = float3{0, 3, 0} - from;
        const double squared = dot(d, d);
        // Exact while the whole sphere is above the horizon.
        EXPECT_NEAR(e.mean, d.y / std::sqrt(squared) / squared, 5.0 * e.standard_error + 1e-6);
    }
}

TEST(SphereLight, ShadowRaysEndAtItsSurface) {
    scene::Light source;
    source.kind = scene::LightKind::spherical;
    source.position = {0, 3, 0};
    source.radius = 1.0f;
    const Light light = make(source, frame::LightMode::area, 16);
    const shared::FrameParams frame{};
    const auto draw = shared::make_light_draw(&light, &frame, 0, 16, 77, 0);
    for (shared::uint i = 0; i < 16; ++i) {
        shared::LightSample s{};
        shared::sample_light(&light, &draw, {0.5f, 0, 0}, i, &s);
        const float3 end = scale_add3(s.direction, s.t_max, {0.5f, 0, 0});
        const float3 d = end - float3{0, 3, 0};
        EXPECT_NEAR(std::sqrt(dot(d, d)), 1.0, 5e-3);
        EXPECT_GE(std::sqrt(dot(d, d)), 1.0);
    }
}

TEST(PointLight, FallsOffWithTheSquareFromItsReferenceDistance) {
    scene::Light source;
    source.position = {0, 4, 0};
    source.attenuation_distance = 2.0f;
    const Light light = make(source, frame::LightMode::point, 8);
    EXPECT_NEAR(irradiance(light, {0, 0, 0}, {0, 1, 0}, 1).mean, 0.25, 1e-6);
    // Distance 5, cosine 4/5.
    EXPECT_NEAR(irradiance(light, {3, 0, 0}, {0, 1, 0}, 1).mean, 4.0 / 25.0 * 0.8, 1e-6);
}

TEST(PointLight, WithoutAReferenceDistanceHasNoFalloff) {
    scene::Light source;
    source.position = {0, 4, 0};
    const Light light = make(source, frame::LightMode::point, 8);
    EXPECT_NEAR(irradiance(light, {3, 0, 0}, {0, 1, 0}, 1).mean, 0.8, 1e-6);
}

TEST(DirectionalLight, GivesTheCosine) {
    scene::Light source;
    source.kind = scene::LightKind::directional;
    source.direction = {0.6f, -0.8f, 0.0f};
    const Light light = make(source, frame::LightMode::area, 8);
    EXPECT_EQ(light.samples, 1u);
    EXPECT_NEAR(irradiance(light, {9, 9, 9}, {0, 1, 0}, 1).mean, 0.8, 1e-6);
}

scene::Light wide_sun(float degrees) {
    scene::Light source;
    source.kind = scene::LightKind::directional;
    source.direction = {0.6f, -0.8f, 0.0f};
    source.angle = degrees;
    return source;
}

TEST(WideLight, GivesTheCosineOfItsMiddleWhileItIsAboveTheHorizon) {
    for (const float degrees : {0.27f, 5.0f, 30.0f}) {
        const Light light = make(wide_sun(degrees), frame::LightMode::soft, 3);
        EXPECT_EQ(light.samples, 3u);
        const Estimate e = irradiance(light, {9, 9, 9}, {0, 1, 0}, 16 * 4096);
        EXPECT_NEAR(e.mean, 0.8, 5.0 * e.standard_error + 1e-6) << degrees;
    }
}

TEST(WideLight, SendsItsRaysIntoItsConeAlone) {
    const Light light = make(wide_sun(2.0f), frame::LightMode::soft, 3);
    const double least = std::cos(2.0 * std::numbers::pi / 180.0);
    const shared::FrameParams frame{};
    double narrowest = 1.0;
    for (const shared::uint texel : frame::blue_noise()) {
        const auto draw = shared::make_light_draw(&light, &frame, 0, 16, 0, texel);
        shared::LightSample s{};
        shared::sample_light(&light, &draw, {1, 2, 3}, 1, &s);
        const double cosine = dot(s.direction, {-0.6f, 0.8f, 0.0f});
        EXPECT_GT(cosine, least - 1e-6);
        narrowest = std::min(narrowest, cosine);
    }
    EXPECT_NEAR(narrowest, least, 1e-5) << "all of it";
}

TEST(WideLight, ReachesASurfaceWhoseHorizonItsMiddleIsBelow) {
    const Light light = make(wide_sun(10.0f), frame::LightMode::soft, 3);
    const auto turned = [](double degrees) { // above the light's direction
        const double turn = (degrees + 36.869898) * std::numbers::pi / 180.0;
        return float3{float(std::cos(turn)), float(std::sin(turn)), 0.0f};
    };
    EXPECT_TRUE(shared::light_may_reach(&light, {0, 0, 0}, turned(9.9)));
    EXPECT_FALSE(shared::light_may_reach(&light, {0, 0, 0}, turned(-10.1)));
}

TEST(SoftLights, GiveWhatAreaLightsGive) {
    scene::Light bulb;
    bulb.kind = scene::LightKind::spherical;
    bulb.position = {0.4f, 2.0f, -0.3f};
    bulb.radius = 0.7f;
    bulb.attenuation_distance = 1.0f;
    const float3 up = {0, 1, 0};
    for (const scene::Light& source : {bulb, rectangle()})
        for (const float3 from : {float3{0, 0, 0}, float3{3, 0, 1}}) {
            const Estimate soft =
                irradiance(make(source, frame::LightMode::soft, 3), from, up, 16 * 4096);
            const Estimate area =
                irradiance(make(source, frame::LightMode::area, 16), from, up, 4096);
            EXPECT_NEAR(soft.mean, area.mean,
                        5.0 * (soft.standard_error + area.standard_error) + 1e-6);
        }
}

TEST(LightModes, CountTheRaysOfThePapersTable) {
    scene::Light bulb;
    bulb.radius = 0.5f;
    EXPECT_EQ(make(bulb, frame::LightMode::point, 8).samples, 1u);
    EXPECT_EQ(make(bulb, frame::LightMode::area, 8).samples, 8u);
    EXPECT_EQ(make(bulb, frame::LightMode::soft, 3).samples, 3u);
    bulb.radius = 0.0f;
    EXPECT_EQ(make(bulb, frame::LightMode::soft, 3).samples, 1u) << "nothing of it is soft";
    EXPECT_TRUE(
        frame::make_lights(scene_with(bulb), frame::LightMode::ambient_occlusion, 8).empty());
    EXPECT_THROW(make(bulb, frame::LightMode::area, 0), std::invalid_argument);
}

// A light that cannot reach a surface gets no rays; one that can must never be skipped.
TEST(LightReach, NeverSkipsALightThatGivesSomething) {
    const std::array<Light, 3> lights{make(rectangle(), frame::LightMode::area, 16),
                                      make(rectangle(), frame::LightMode::point, 1), [] {
                                          scene::Light bulb;
                                          bulb.position = {0.4f, 2.0f, -0.3f};
                                          bulb.radius = 0.7f;
                                          return make(bulb, frame::LightMode::area, 16);
                                      }()};
    int skipped = 0;
    for (const Light& light : lights)
        for (shared::uint i = 0; i < 3000; ++i) {
            const shared::uint key = shared::random_key(i, 5, 5);
            const auto in = [&](shared::uint d) {
                return 6.0f * shared::random_unit(key, 0, d) - 3.0f;
            };
            const float3 from = {in(0), in(1), in(2)};
            const float3 n = shared::unit3({in(3), in(4), in(5)}, {0, 0, 1});
            const bool reaches = shared::light_may_reach(&light, from, n);
            skipped += reaches ? 0 : 1;
            if (!reaches) {
                EXPECT_EQ(irradiance(light, from, n, 4).mean, 0.0);
            }
        }
    EXPECT_GT(skipped, 1000);
}

TEST(Phong, PeaksInTheMirrorDirection) {
    const float3 n = {0, 1, 0};
    const float3 light = unit3({-0.5f, 0.8f, 0.1f}, n), mirror = {-light.x, light.y, -light.z};
    EXPECT_NEAR(shared::phong_lobe(n, light, mirror, 50.0f), 1.0f, 1e-4f);
    for (float turn = 0.05f; turn < 1.0f; turn += 0.1f) {
        const float3 off = unit3(mirror + float3{turn, 0, 0}, n);
        const double cosine = dot(off, mirror);
        EXPECT_NEAR(shared::phong_lobe(n, light, off, 50.0f), std::pow(cosine, 50.0), 2e-4);
    }
    EXPECT_EQ(shared::phong_lobe(n, light, -mirror, 50.0f), 0.0f);
}

} // namespace
