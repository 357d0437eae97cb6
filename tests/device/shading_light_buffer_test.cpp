// Irradiance and ambient occlusion of simple configurations against closed forms.
#include <gtest/gtest.h>

#include "host/cl/device.hpp"
#include "tests/support/small_scenes.hpp"

namespace {
using namespace macula;
using namespace macula::test;
using frame::LightMode;

compute::Device& device() {
    static compute::Device opened = compute::open();
    return opened;
}

render::Options options(LightMode lights, std::vector<std::string> images,
                        std::uint32_t samples_per_pixel = 1) {
    render::Options o;
    o.width = 96;
    o.height = 72;
    o.lights = lights;
    o.samples_per_pixel = samples_per_pixel;
    o.images = std::move(images);
    return o;
}

// A floor y = 0 of half size `size`.
scene::Mesh floor_mesh(float size) {
    scene::Mesh mesh;
    add_quad(mesh, {-size, 0, -size}, {0, 0, 2 * size}, {2 * size, 0, 0});
    return mesh;
}

scene::Scene floor_under(const scene::Light& light) {
    scene::Scene scene = scene_of(floor_mesh(50), {{0, 3, 4}, {0, 0, 0}});
    scene.lights = {light};
    return scene;
}

// Lambert's formula for a polygon of radiance 1 above the horizon of `n`.
double lambert(const std::vector<glm::dvec3>& corners, glm::dvec3 from, glm::dvec3 n) {
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = corners[i] - from, b = corners[(i + 1) % corners.size()] - from;
        const glm::dvec3 c = glm::cross(a, b);
        const double size = glm::length(c);
        if (size > 0)
            sum += std::atan2(size, glm::dot(a, b)) * glm::dot(n, c) / size;
    }
    return std::fabs(sum) / 2.0;
}

TEST(Irradiance, OfAPointLightIsCosineOverSquare) {
    scene::Light light;
    light.position = {1, 2, -1};
    light.colour = {3, 2, 1};
    light.attenuation_distance = 1.0f;
    render::Renderer renderer(device(), floor_under(light),
                              options(LightMode::point, {"irradiance", "position"}));
    renderer.render(0);
    const render::Image irradiance = renderer.map("irradiance"),
                        position = renderer.map("position");
    for (std::uint32_t i = 0; i < pixels(irradiance); ++i) {
        const glm::dvec3 d = glm::dvec3(1, 2, -1) - at(position, i);
        const double expected = d.y / std::pow(glm::dot(d, d), 1.5);
        const glm::dvec3 found = at(irradiance, i);
        ASSERT_NEAR(found.x, 3 * expected, 1e-5 * 3 * expected);
        ASSERT_NEAR(found.y, 2 * expected, 1e-5 * 2 * expected);
        ASSERT_NEAR(found.z, expected, 1e-5 * expected);
    }
}

TEST(Irradiance, OfARectangleIsLamberts) {
    scene::Light light;
    light.kind = scene::LightKind::rectangle;
    light.position = {0, 2, 0};
    light.edge_u = {2, 0, 0};
    light.edge_v = {0, 0, 1};
    light.attenuation_distance = 1.0f;
    render::Options o = options(LightMode::area, {"irradiance", "position"});
    o.light_samples = 64;
    render::Renderer renderer(device(), floor_under(light), o);
    renderer.render(0);
    const std::vector<glm::dvec3> corners{{-1, 2, -0.5}, {1, 2, -0.5}, {1, 2, 0.5}, {-1, 2, 0.5}};
    const render::Image irradiance = renderer.map("irradiance"),
                        position = renderer.map("position");
    Deviation relative;
    for (std::uint32_t i = 0; i < pixels(irradiance); ++i) {
        const double expected = lambert(corners, at(position, i), {0, 1, 0}) / 2.0;
        relative.add(at(irradiance, i).x / expected - 1.0);
    }
    EXPECT_NEAR(relative.mean(), 0.0, 4.0 * relative.standard_error() + 1e-5);
    EXPECT_LT(relative.standard_error(), 1e-3);
}

TEST(Irradiance, OfASphereIsThatOfItsCentre) {
    scene::Light light;
    light.kind = scene::LightKind::spherical;
    light.position = {0, 2, 0};
    light.radius = 0.5f;
    light.attenuation_distance = 1.0f;
    render::Renderer renderer(device(), floor_under(light),
                              options(LightMode::area, {"irradiance", "position"}));
    renderer.render(0);
    const render::Image irradiance = renderer.map("irradiance"),
                        position = renderer.map("position");
    Deviation relative;
    for (std::uint32_t i = 0; i < pixels(irradiance); ++i) {
        const glm::dvec3 d = glm::dvec3(0, 2, 0) - at(position, i);
        // A sphere entirely above the horizon: all of these are.
        relative.add(at(irradiance, i).x * std::pow(glm::dot(d, d), 1.5) / d.y - 1.0);
    }
    EXPECT_NEAR(relative.mean(), 0.0, 4.0 * relative.standard_error() + 1e-5);
    EXPECT_LT(relative.standard_error(), 1e-2);
}

TEST(Irradiance, BehindAnObstacleIsZero) {
    scene::Mesh mesh = floor_mesh(50);
    add_quad(mesh, {-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1});
    scene::Scene scene = scene_of(std::move(mesh), {{0, 3, 4}, {0, 0, 0}});
    scene.lights.emplace_back();
    scene.lights[0].position = {0, 2, 0};
    render::Renderer renderer(device(), scene,
                              options(LightMode::point, {"irradiance", "position"}));
    renderer.render(0);
    const render::Image irradiance = renderer.map("irradiance"),
                        position = renderer.map("position");
    int dark = 0, lit = 0;
    for (std::uint32_t i = 0; i < pixels(irradiance); ++i) {
        const glm::dvec3 p = at(position, i);
        if (std::fabs(p.y) > 0.5)
            continue; // the obstacle itself
        // The shadow of the square is the square of twice the size.
        const double reach = std::max(std::fabs(p.x), std::fabs(p.z));
        if (reach < 0.999) {
            EXPECT_EQ(at(irradiance, i).x, 0.0);
            ++dark;
        } else if (reach > 1.001) {
            EXPECT_GT(at(irradiance, i).x, 0.0);
            ++lit;
        }
    }
    EXPECT_GT(dark, 100);
    EXPECT_GT(lit, 100);
}

TEST(AmbientOcclusion, OfAnOpenPlaneIsNone) {
    render::Renderer renderer(device(), scene_of(floor_mesh(50), {{0, 3, 4}, {0, 0, 0}}),
                              options(LightMode::ambient_occlusion, {"ambient occlusion"}));
    renderer.render(0);
    const render::Image openness = renderer.map("ambient occlusion");
    for (const float value : openness.floats)
        ASSERT_EQ(value, 1.0f);
}

// A floor and a wall x = 0 so large that it has no end: `part(distance)` is occluded.
void expect_corner(float radius, double (*part)(double distance, double radius)) {
    constexpr float kSize = 4000;
    scene::Mesh mesh;
    add_quad(mesh, {0, 0, -kSize}, {0, 0, 2 * kSize}, {kSize, 0, 0});
    add_quad(mesh, {0, 0, -kSize}, {0, kSize, 0}, {0, 0, 2 * kSize});
    render::Options o = options(LightMode::ambient_occlusion, {"ambient occlusion", "position"}, 4);
    o.ambient_occlusion_radius = radius;
    render::Renderer renderer(device(), scene_of(std::move(mesh), {{2, 2, 0}, {1.2f, 0, 0}, 50}),
                              o);
    renderer.render(0);
    const render::Image openness = renderer.map("ambient occlusion");
    const render::Image position = renderer.map("position");
    Deviation difference;
    for (std::uint32_t i = 0; i < pixels(openness); ++i) {
        const glm::dvec3 p = at(position, i);
        if (p.y < 1e-3 && p.x > 0.3)
            difference.add(1.0 - at(openness, i).x - part(p.x, radius));
    }
    EXPECT_GT(difference.count, 3000u);
    EXPECT_NEAR(difference.mean(), 0.0, 4.0 * difference.standard_error() + 2e-3);
    EXPECT_LT(difference.standard_error(), 2e-3);
}

// Half of the cosine-weighted hemisphere lies behind any endless wall.
TEST(AmbientOcclusion, BesideAnEndlessWallIsOneHalf) {
    expect_corner(3000.0f, [](double, double) { return 0.5; });
}

// Within radius R of distance a: the part of the unit disk beyond x = a / R.
TEST(AmbientOcclusion, EndsAtItsRadius) {
    expect_corner(2.0f, [](double distance, double radius) {
        const double c = std::min(distance / radius, 1.0);
        return (std::acos(c) - c * std::sqrt(1.0 - c * c)) / std::numbers::pi;
    });
}

struct Placing {
    const char* name;
    float scale;
    glm::vec3 moved;
    float degrees;
};
std::ostream& operator<<(std::ostream& out, const Placing& p) {
    return out << p.name;
}

class Furnace : public testing::TestWithParam<Placing> {
  protected:
    // A white sphere under a white sky, seen from outside; the camera moves with it.
    scene::Scene sphere() const {
        const Placing& p = GetParam();
        return scene_of(icosphere(3),
                        {p.moved + p.scale * glm::vec3(0.3f, 0.4f, 3.0f), p.moved, 60.0f},
                        oblique(p.degrees, p.scale, p.moved));
    }
};

// A convex surface sees nothing of itself: each ray that hits it betrays a bad offset.
TEST_P(Furnace, AConvexSurfaceDoesNotOccludeItself) {
    scene::Scene scene = sphere();
    scene.background = glm::vec3(1.0f);
    render::Options o = options(LightMode::ambient_occlusion, {});
    o.ambient_occlusion_radius = 10.0f * GetParam().scale;
    render::Renderer renderer(device(), scene, o);
    renderer.render(0);
    const render::Image colour = renderer.map("colour");
    int wrong = 0;
    for (std::uint32_t i = 0; i < pixels(colour); ++i)
        wrong += at(colour, i) != glm::dvec3(1.0) ? 1 : 0;
    EXPECT_EQ(wrong, 0);
}

// From inside nothing of the sky is seen.
TEST_P(Furnace, AClosedSurfaceLeaksNothing) {
    const Placing& p = GetParam();
    scene::Scene scene = scene_of(icosphere(3), {p.moved, p.moved + p.scale * glm::vec3(1, 2, 3)},
                                  oblique(p.degrees, p.scale, p.moved));
    scene.background = glm::vec3(1.0f);
    render::Options o = options(LightMode::ambient_occlusion, {});
    o.ambient_occlusion_radius = 10.0f * p.scale;
    render::Renderer renderer(device(), scene, o);
    renderer.render(0);
    const render::Image colour = renderer.map("colour");
    int wrong = 0;
    for (std::uint32_t i = 0; i < pixels(colour); ++i)
        wrong += at(colour, i) != glm::dvec3(0.0) ? 1 : 0;
    EXPECT_EQ(wrong, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Places, Furnace,
    testing::Values(Placing{"unit", 1, {0, 0, 0}, 0}, Placing{"turned", 1, {0, 0, 0}, 40},
                    Placing{"as_small_as_the_bunny", 0.07f, {0.02f, 0.1f, 0}, 0},
                    Placing{"as_large_as_sponza", 1900, {-60, 650, 40}, 0},
                    Placing{"turned_and_large", 1900, {-60, 650, 40}, 70},
                    Placing{"a_thousand_radii_away", 1, {1000, -700, 400}, 25},
                    Placing{"tiny", 1e-6f, {0, 0, 0}, 10}, Placing{"huge", 1e7f, {0, 0, 0}, 10}),
    [](const auto& place) { return std::string(place.param.name); });

} // namespace
