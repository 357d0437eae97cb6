// Reflected and refracted rays in whole frames: what a mirror shows, where rays go, what they cost.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/cl/device.hpp"
#include "scenes/load.hpp"
#include "scenes/procedural/textures.hpp"
#include "tests/support/small_scenes.hpp"
#include "tests/support/weier_frames.hpp"

namespace {
using namespace macula;
using namespace macula::test;
using frame::LightMode;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

compute::Device& device() {
    static compute::Device opened = compute::open();
    return opened;
}

render::Options options(std::uint32_t depth, LightMode lights = LightMode::point) {
    render::Options o;
    o.width = 96;
    o.height = 80;
    o.lights = lights;
    o.depth = depth;
    return o;
}

std::string hash_of(const scene::Scene& scene, const render::Options& o) {
    render::Renderer renderer(device(), scene, o);
    renderer.render(0);
    return renderer.hash();
}

scene::Material& add_material(scene::Scene& scene) {
    scene.materials.emplace_back();
    scene.materials.back().diffuse = glm::vec3(0.0f);
    return scene.materials.back();
}

// A textured floor and a sphere in front of z = 0, lit by a point light; the mirror, if any, lies
// in z = 0.
scene::Scene room(bool mirror, View view, bool blended = false) {
    scene::Mesh mesh = icosphere(2);
    for (glm::vec3& p : mesh.positions)
        p = 0.6f * p + glm::vec3(0.4f, 0.1f, 6.5f);
    for (const glm::vec3& p : mesh.positions)
        mesh.uvs.emplace_back(p.x, p.y);
    const auto floor = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(),
                          {{-9, -1, 0.5f}, {-9, -1, 20}, {9, -1, 20}, {9, -1, 0.5f}});
    mesh.uvs.insert(mesh.uvs.end(), {{-9, 0.5f}, {-9, 20}, {9, 20}, {9, 0.5f}});
    mesh.triangles.insert(mesh.triangles.end(),
                          {{floor, floor + 1, floor + 2}, {floor, floor + 2, floor + 3}});
    mesh.triangle_material.assign(mesh.triangles.size(), 0);
    if (mirror) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(),
                              {{-40, -40, 0}, {40, -40, 0}, {40, 40, 0}, {-40, 40, 0}});
        mesh.uvs.resize(mesh.positions.size());
        mesh.triangles.insert(mesh.triangles.end(),
                              {{first, first + 1, first + 2}, {first, first + 2, first + 3}});
        mesh.triangle_material.insert(mesh.triangle_material.end(), {0, 0});
    }
    scene::Scene scene = scene_of(std::move(mesh), view);
    add_material(scene).reflectivity = glm::vec3(1.0f);
    if (mirror) {
        auto& painted = scene.meshes[0].triangle_material;
        painted.back() = painted[painted.size() - 2] = 1;
    }
    scene.materials[0].diffuse_texture =
        scene::procedural::add_texture(scene, "board", {64, 64}, [](glm::vec2 uv) {
            const bool odd = (uv.x < 0.5f) != (uv.y < 0.5f);
            return scene::procedural::Texel{odd ? scene::procedural::rgb(0xf0d020)
                                                : scene::procedural::rgb(0x203080)};
        });
    scene.materials[0].specular = glm::vec3(0.4f);
    if (blended) { // the sphere
        scene::Material& pane = add_material(scene);
        pane.diffuse = {0.2f, 0.9f, 0.4f};
        pane.alpha_mode = scene::AlphaMode::blend;
        pane.opacity = 0.4f;
        std::fill_n(scene.meshes[0].triangle_material.begin(), icosphere(2).triangles.size(), 2u);
    }
    scene.ambient = glm::vec3(0.2f);
    scene.background = {0.1f, 0.2f, 0.4f};
    scene.lights.emplace_back();
    scene.lights[0].position = {3, 5, 5};
    return scene;
}

class Mirror : public testing::TestWithParam<bool> {};

// Position, direction, cone (by the texture's level of detail), light, shadow, highlight and
// blended layers are all those of the camera behind the mirror.
TEST_P(Mirror, ShowsWhatTheMirroredCameraSees) {
    const scene::Scene with = room(true, {{0.2f, 0.3f, 3}, {0.2f, 0.3f, -1}, 48.0f}, GetParam());
    const scene::Scene without =
        room(false, {{0.2f, 0.3f, -3}, {0.2f, 0.3f, 1}, 48.0f}, GetParam());
    render::Renderer reflected(device(), with, options(1)), seen(device(), without, options(0));
    reflected.render(0);
    seen.render(0);
    const render::Image a = reflected.map("colour"), b = seen.map("colour");
    std::uint32_t differing = 0;
    for (std::uint32_t y = 0; y < a.height; ++y)
        for (std::uint32_t x = 0; x < a.width; ++x) {
            const glm::dvec3 mirrored = at(b, y * b.width + (b.width - 1 - x));
            differing += glm::length(at(a, y * a.width + x) - mirrored) > 2e-3 ? 1 : 0;
        }
    // Those of edges, which a rounding decides.
    EXPECT_LT(differing, pixels(a) / 200);
    EXPECT_NE(hash_of(with, options(0)), hash_of(with, options(1)));
}

INSTANTIATE_TEST_SUITE_P(Of, Mirror, testing::Bool(), [](const auto& blended) {
    return std::string(blended.param ? "BlendedSphere" : "OpaqueSphere");
});

TEST(Depth, ZeroIsThePictureOfTheSceneWithoutReflection) {
    scene::Scene scene = scene::load("whitted");
    const std::string zero = hash_of(scene, options(0));
    EXPECT_NE(hash_of(scene, options(1)), zero);
    for (scene::Material& m : scene.materials)
        m.reflectivity = m.transmission = glm::vec3(0.0f);
    EXPECT_EQ(hash_of(scene, options(4)), zero);
}

TEST(Depth, AddsNoStageWhereNothingReflects) {
    const scene::Scene scene = scene::load("cornell");
    for (const char* method : {"full", "weier", "lowres", "logpolar", "logrect"}) {
        render::Options o = options(4);
        o.method = method;
        render::Renderer renderer(device(), scene, o);
        EXPECT_THAT(renderer.explain(), Not(HasSubstr("bounce"))) << method;
    }
}

TEST(Depth, OutOfRangeIsAnError) {
    EXPECT_THAT([] { render::Renderer(device(), scene::load("whitted"), options(17)); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("depth 17")));
}

TEST(Depth, EveryMethodFollowsRays) {
    const scene::Scene scene = scene::load("whitted");
    for (const char* method : {"full", "weier", "lowres", "logpolar", "logrect"}) {
        render::Options o = options(2);
        o.method = method;
        const std::string deep = hash_of(scene, o);
        o.depth = 0;
        EXPECT_NE(hash_of(scene, o), deep) << method;
    }
}

class EachMode : public testing::TestWithParam<LightMode> {};

TEST_P(EachMode, OneAndSixteenLanesGiveTheSameBits) {
    const scene::Scene scene = scene::load("whitted");
    render::Options o = options(5, GetParam());
    o.lanes = 1;
    const std::string one = hash_of(scene, o);
    o.lanes = 16;
    EXPECT_EQ(hash_of(scene, o), one);
}

// In a white surrounding nothing is brighter than white, whatever it is made of, and what neither
// absorbs nor runs out of levels is just as bright.
TEST_P(EachMode, AWhiteFurnaceIsNowhereBrighterThanWhite) {
    const auto picture = [](const scene::Material& made_of, std::uint32_t depth) {
        scene::Mesh ball = icosphere(3);
        ball.normals = ball.positions;
        scene::Scene scene = scene_of(std::move(ball), {{0, 0, 3}, {0, 0, 0}, 45.0f});
        scene.materials[0] = made_of;
        scene.background = scene.ambient = glm::vec3(1.0f);
        render::Renderer renderer(device(), scene, options(depth, GetParam()));
        renderer.render(0);
        const render::Image colour = renderer.map("colour");
        glm::dvec2 range(1e9, 0.0);
        for (std::uint32_t i = 0; i < pixels(colour); ++i) {
            range.x = std::min(range.x, at(colour, i).x);
            range.y = std::max(range.y, at(colour, i).x);
        }
        return range;
    };
    scene::Material mirror, glass, greedy;
    mirror.diffuse = glm::vec3(0.0f);
    mirror.reflectivity = glm::vec3(1.0f);
    glass.diffuse = glm::vec3(0.0f);
    glass.transmission = glm::vec3(1.0f);
    greedy.diffuse = glm::vec3(0.9f);
    greedy.reflectivity = glm::vec3(0.8f);
    greedy.transmission = glm::vec3(0.7f);
    EXPECT_GE(picture(mirror, 1).x, 1.0 - 1e-5);
    for (const std::uint32_t depth : {1u, 3u, 12u})
        for (const scene::Material& m : {mirror, glass, greedy})
            EXPECT_LE(picture(m, depth).y, 1.0 + 1e-5) << depth;
    // Paths of weights below 1/256 are left out.
    EXPECT_GE(picture(glass, 12).x, 0.95);
}

INSTANTIATE_TEST_SUITE_P(Lights, EachMode,
                         testing::Values(LightMode::point, LightMode::area,
                                         LightMode::ambient_occlusion),
                         [](const auto& mode) { return std::string(frame::name(mode.param)); });

// A glass plate of one unit before the camera; its faces wind outwards.
scene::Scene plate(float index_of_refraction, float size = 50.0f) {
    scene::Mesh mesh;
    add_quad(mesh, {-size, -size, 0}, {2 * size, 0, 0}, {0, 2 * size, 0});
    add_quad(mesh, {-size, -size, -1}, {0, 2 * size, 0}, {2 * size, 0, 0});
    scene::Scene scene = scene_of(std::move(mesh), {{0, 0, 3}, {0.8f, 0.5f, 0}});
    scene.materials[0].diffuse = glm::vec3(0.0f);
    scene.materials[0].transmission = glm::vec3(1.0f);
    scene.materials[0].index_of_refraction = index_of_refraction;
    scene.background = glm::vec3(1.0f);
    return scene;
}

struct RayAt {
    glm::dvec3 origin, direction;
    bool active;
};
RayAt ray_at(const std::vector<shared::RayBlock>& rays, std::size_t i) {
    const shared::RayBlock& b = rays[i / 16];
    const std::size_t k = i % 16;
    return {{b.origin_x[k], b.origin_y[k], b.origin_z[k]},
            {b.direction_x[k], b.direction_y[k], b.direction_z[k]},
            b.t_max[k] >= 0.0f};
}

TEST(Refraction, GoesThroughAPlateBySnellsLaw) {
    const scene::Scene scene = plate(1.5f);
    WeierSetup setup;
    setup.method = "full";
    setup.width = setup.height = 40;
    setup.depth = 2;
    setup.outputs = {"primary rays",  "bounce 1 rays", "bounce 1 root",
                     "bounce 2 rays", "bounce 2 root", "bounce 2 ray count"};
    WeierFrames frames(device(), scene, setup);
    frames.run(0, scene.cameras[0]);
    const auto primary = frames.read<shared::RayBlock>("primary rays");
    const auto first = frames.read<shared::RayBlock>("bounce 1 rays");
    const auto first_root = frames.read<std::uint32_t>("bounce 1 root");
    ASSERT_GT(frames.rays(kernel::RayClass::diffuse), 2u * 40 * 40);
    std::uint32_t down = 0;
    for (std::size_t i = 0; i < 2u * 40 * 40; ++i) {
        const RayAt ray = ray_at(first, i);
        ASSERT_TRUE(ray.active);
        const glm::dvec3 in = glm::normalize(ray_at(primary, first_root[i]).direction);
        EXPECT_NEAR(std::abs(ray.origin.z), 0.0, 1e-3);
        if (ray.direction.z > 0.0) {
            EXPECT_LT(glm::length(ray.direction - glm::dvec3(in.x, in.y, -in.z)), 1e-5);
        } else {
            const glm::dvec2 sideways(in.x / 1.5, in.y / 1.5);
            const double deep = std::sqrt(1.0 - glm::dot(sideways, sideways));
            EXPECT_LT(glm::length(ray.direction - glm::dvec3(sideways, -deep)), 1e-5);
            ++down;
        }
    }
    EXPECT_EQ(down, 40u * 40);
    // Behind the plate rays run on as they came.
    const auto second = frames.read<shared::RayBlock>("bounce 2 rays");
    const auto second_root = frames.read<std::uint32_t>("bounce 2 root");
    const auto count = frames.read<std::uint32_t>("bounce 2 ray count")[0];
    std::uint32_t out = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const RayAt ray = ray_at(second, i);
        if (!ray.active || ray.direction.z > 0.0)
            continue;
        ++out;
        EXPECT_NEAR(ray.origin.z, -1.0, 1e-3);
        const glm::dvec3 in = glm::normalize(ray_at(primary, second_root[i]).direction);
        EXPECT_LT(glm::length(ray.direction - in), 1e-5);
    }
    EXPECT_EQ(out, 40u * 40);
}

TEST(Refraction, APlateInAWhiteSurroundingIsWhite) {
    const scene::Scene scene = plate(1.5f);
    render::Renderer renderer(device(), scene, options(16));
    renderer.render(0);
    const render::Image colour = renderer.map("colour");
    for (std::uint32_t i = 0; i < pixels(colour); ++i) {
        EXPECT_LE(at(colour, i).x, 1.0 + 1e-5);
        EXPECT_GE(at(colour, i).x, 0.98); // what falls below the threshold
    }
}

// Both rays of all hits of the first level find something in turn: of four rays to a pixel two have
// a place.
TEST(Queue, AHitsStrongerRayAlwaysHasAPlaceAndTheWeakestGoFirst) {
    scene::Mesh mesh = icosphere(2), outer = icosphere(2);
    const auto inner = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec3& p : outer.positions)
        mesh.positions.push_back(4.0f * p);
    for (const glm::uvec3& t : outer.triangles)
        mesh.triangles.push_back(t + inner);
    mesh.triangle_material.resize(mesh.triangles.size());
    scene::Scene scene = scene_of(std::move(mesh), {{0, 0, 0}, {0, 0, -1}});
    scene.materials[0].diffuse = glm::vec3(0.0f);
    scene.materials[0].reflectivity = glm::vec3(0.75f);
    scene.materials[0].transmission = glm::vec3(0.25f);
    scene.materials[0].index_of_refraction = 1.0f;
    scene.background = glm::vec3(1.0f);
    const auto diffuse = static_cast<std::size_t>(kernel::RayClass::diffuse);
    std::vector<std::string> hashes;
    for (const std::uint32_t lanes : {1u, 16u}) {
        render::Options o = options(2);
        o.lanes = lanes;
        o.width = o.height = 64; // all slots are pixels
        render::Renderer full(device(), scene, o);
        EXPECT_EQ(full.render(0).rays[diffuse], (2u + 2u) * 64 * 64);
        hashes.push_back(full.hash());
        o.width = o.height = 40; // some slots are free
        render::Renderer small(device(), scene, o);
        EXPECT_EQ(small.render(0).rays[diffuse], (2u + 4u) * 40 * 40);
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(Winding, TellsInsideFromOutsideAlsoWhereAnInstanceMirrors) {
    const auto picture = [](bool mirrored) {
        scene::Mesh mesh = icosphere(3);
        scene::Transform placed;
        if (mirrored)
            placed.row[0].x = -1.0f;
        scene::Scene scene = scene_of(std::move(mesh), {{0, 0, 3}, {0, 0, 0}, 45.0f}, placed);
        scene.materials[0].diffuse = glm::vec3(0.0f);
        scene.materials[0].transmission = glm::vec3(1.0f);
        scene.background = glm::vec3(1.0f);
        render::Renderer renderer(device(), scene, options(1));
        renderer.render(0);
        return at(renderer.map("colour"), 40 * 96 + 48).x;
    };
    // Straight on, four percent are reflected to the background; what is refracted stays inside.
    EXPECT_NEAR(picture(false), 0.04, 2e-3);
    EXPECT_NEAR(picture(true), 0.04, 2e-3);
}

} // namespace
