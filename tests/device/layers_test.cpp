// Blended surfaces: K layers along a ray against all of them sorted by brute force.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/cl/device.hpp"
#include "host/frame/blended.hpp"
#include "scenes/load.hpp"
#include "scenes/procedural/textures.hpp"
#include "tests/support/small_scenes.hpp"

namespace {
using namespace macula;
using namespace macula::test;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

compute::Device& device() {
    static compute::Device opened = compute::open();
    return opened;
}

// A pane that faces the eye at the origin, glowing, with its opacity.
struct Pane {
    float distance;
    glm::vec3 glow;
    float opacity;
};

// Panes in any order before a white wall at 10; the eye looks along -z.
scene::Scene panes(const std::vector<Pane>& all) {
    scene::Mesh mesh;
    add_quad(mesh, {-50, -50, -10}, {100, 0, 0}, {0, 100, 0});
    for (const Pane& pane : all)
        add_quad(mesh, {-50, -50, -pane.distance}, {100, 0, 0}, {0, 100, 0});
    scene::Scene scene = scene_of(std::move(mesh), {{0, 0, 0}, {0, 0, -1}});
    scene.materials[0].diffuse = glm::vec3(0.0f);
    scene.materials[0].emission = glm::vec3(1.0f);
    std::vector<std::uint32_t>& material = scene.meshes[0].triangle_material;
    for (std::size_t i = 0; i < all.size(); ++i) {
        scene::Material m;
        m.diffuse = glm::vec3(0.0f);
        m.emission = all[i].glow;
        m.opacity = all[i].opacity;
        m.alpha_mode = scene::AlphaMode::blend;
        material[2 + 2 * i] = material[3 + 2 * i] = static_cast<std::uint32_t>(i + 1);
        scene.materials.push_back(m);
    }
    return scene;
}

// Sorted by depth, the nearest `kept` blended over the wall; those behind merged into the last.
glm::dvec3 sorted(std::vector<Pane> all, std::size_t kept) {
    std::ranges::stable_sort(all, {}, &Pane::distance);
    glm::dvec3 colour(0.0);
    double clear = 1.0;
    for (std::size_t i = 0; i < std::min(kept, all.size()); ++i) {
        double passes = 1.0 - all[i].opacity;
        if (i + 1 == kept)
            for (std::size_t behind = kept; behind < all.size(); ++behind)
                passes *= 1.0 - all[behind].opacity;
        colour += clear * (1.0 - passes) * glm::dvec3(all[i].glow);
        clear *= passes;
    }
    return colour + glm::dvec3(clear);
}

render::Options options(std::uint32_t layers) {
    render::Options o;
    o.width = 64;
    o.height = 48;
    o.layers = layers;
    return o;
}

const std::vector<Pane> kPanes = {{5, {1, 0, 0}, 0.5f},    {2, {0, 1, 0}, 0.25f},
                                  {9, {0, 0, 1}, 0.75f},   {3.5f, {1, 1, 0}, 0.4f},
                                  {7, {0.2f, 1, 1}, 0.3f}, {6.5f, {1, 0, 1}, 0.6f}};

TEST(Layers, AreBlendedAsSortingThemBlendsThem) {
    std::vector<Pane> some;
    for (const Pane& pane : kPanes) {
        some.push_back(pane);
        const scene::Scene scene = panes(some);
        for (const std::uint32_t kept : {1u, 2u, 4u, 6u, 16u}) {
            render::Renderer renderer(device(), scene, options(kept));
            renderer.render(0);
            const render::Image colour = renderer.map("colour");
            const glm::dvec3 expected = sorted(some, kept);
            // 64 x 48 pixels look through no more than 2 * 64 * 64 layers: two of each at least.
            const glm::dvec3 two = sorted(some, std::min<std::size_t>(kept, 2));
            const bool room = some.size() * 64 * 48 <= 2u * 64 * 64 || kept <= 2;
            for (std::uint32_t i = 0; i < pixels(colour); ++i)
                ASSERT_LT(glm::length(at(colour, i) - (room ? expected : two)), 1e-5)
                    << some.size() << " panes, " << kept << " kept, pixel " << i;
        }
    }
}

// At the same distance the triangles' order decides, whichever of them traversal finds first.
TEST(Layers, AtEqualDepthsTheEarlierTriangleIsInFront) {
    const std::vector<Pane> some = {
        {4, {1, 0, 0}, 0.5f}, {4, {0, 1, 0}, 0.5f}, {2, {0, 0, 1}, 0.3f}, {4, {1, 1, 0}, 0.4f}};
    for (const std::uint32_t kept : {1u, 2u, 3u, 4u, 8u}) {
        render::Options o = options(kept);
        o.width = o.height = 33; // with room for all
        render::Renderer renderer(device(), panes(some), o);
        renderer.render(0);
        const render::Image colour = renderer.map("colour");
        for (std::uint32_t i = 0; i < pixels(colour); ++i)
            ASSERT_LT(glm::length(at(colour, i) - sorted(some, kept)), 1e-5) << kept << ' ' << i;
    }
}

// Where the picture leaves slots free all layers find a place.
TEST(Layers, AllAreKeptWhereThereIsRoom) {
    const scene::Scene scene = panes(kPanes);
    for (const std::uint32_t kept : {1u, 3u, 4u, 5u, 6u, 16u}) {
        render::Options o = options(kept);
        o.width = o.height = 33; // 4 x 1024 slots for 1089 pixels
        render::Renderer renderer(device(), scene, o);
        renderer.render(0);
        const render::Image colour = renderer.map("colour");
        for (std::uint32_t i = 0; i < pixels(colour); ++i)
            ASSERT_LT(glm::length(at(colour, i) - sorted(kPanes, kept)), 1e-5) << kept << ' ' << i;
    }
}

TEST(Layers, BitsDependNeitherOnLanesNorOnTheMethodsList) {
    const scene::Scene scene = panes(kPanes);
    std::vector<std::string> hashes;
    for (const std::uint32_t lanes : {1u, 16u})
        for (const char* method : {"full", "weier"}) {
            render::Options o = options(4);
            o.lanes = lanes;
            o.method = method;
            render::Renderer renderer(device(), scene, o);
            renderer.render(0); // without history weier takes all pixels
            hashes.push_back(renderer.hash());
        }
    for (const std::string& hash : hashes)
        EXPECT_EQ(hash, hashes[0]);
}

TEST(Layers, AlphaOfATextureIsItsOpacity) {
    scene::Scene scene = panes({{5, {1, 0, 0}, 1.0f}});
    scene.meshes[0].uvs.assign(scene.meshes[0].positions.size(), glm::vec2(0.0f));
    for (std::size_t i = 0; i < scene.meshes[0].positions.size(); ++i)
        scene.meshes[0].uvs[i] = glm::vec2(scene.meshes[0].positions[i]) * 0.01f + 0.5f;
    scene.materials[1].diffuse_texture =
        scene::procedural::add_texture(scene, "halves", {2, 2}, [](glm::vec2 uv) {
            return scene::procedural::Texel{glm::vec3(0.5f), 0.0f, uv.x < 0.5f ? 0.2f : 0.0f};
        });
    render::Renderer renderer(device(), scene, options(4));
    renderer.render(0);
    const render::Image colour = renderer.map("colour");
    // In the middle the two texels' alphas are mixed; a byte holds 51 of 255.
    const double left = at(colour, 24 * 64).y, right = at(colour, 24 * 64 + 63).y;
    EXPECT_GT(right, left);
    EXPECT_NEAR(left + right, 2.0 - 0.2, 0.01);
    EXPECT_NEAR(at(colour, 24 * 64 + 32).y, 0.9, 0.01);
}

TEST(Layers, LetShadowRaysPass) {
    scene::Mesh mesh;
    add_quad(mesh, {-5, -5, -4}, {10, 0, 0}, {0, 10, 0});
    add_quad(mesh, {-5, -5, -2}, {10, 0, 0}, {0, 10, 0});
    scene::Scene scene = scene_of(std::move(mesh), {{0, 0, 0}, {0, 0, -1}, 30.0f});
    scene.materials.push_back(scene.materials[0]);
    scene.materials[1].alpha_mode = scene::AlphaMode::blend;
    scene.materials[1].opacity = 0.0f;
    scene.lights.emplace_back();
    scene.lights[0].position = {0, 0, 1};
    render::Renderer without(device(), scene, options(4));
    without.render(0);
    scene.meshes[0].triangle_material = {0, 0, 1, 1};
    render::Renderer with(device(), scene, options(4));
    with.render(0);
    EXPECT_GT(at(with.map("colour"), 24 * 64 + 32).x, 0.5);
    EXPECT_NE(with.hash(), without.hash()); // which shows the nearer wall
}

TEST(Layers, MoveWithTheirInstances) {
    scene::Scene scene = panes({{5, {1, 0, 0}, 0.5f}});
    scene::Mesh pane = scene.meshes[0], wall = scene.meshes[0];
    pane.triangles.erase(pane.triangles.begin(), pane.triangles.begin() + 2);
    pane.triangle_material = {1, 1};
    wall.triangles.resize(2);
    wall.triangle_material = {0, 0};
    scene.meshes = {wall, pane};
    scene.instances = {{0, {}, "wall"}, {1, {}, "pane"}};
    render::Options o = options(4);
    o.geometry.merge_static = false;
    render::Renderer renderer(device(), scene, o);
    renderer.render(0);
    EXPECT_NEAR(at(renderer.map("colour"), 24 * 64 + 32).y, 0.5, 1e-6);
    scene::Transform aside;
    aside.row[0].w = 200.0f;
    const scene::Transform transforms[] = {{}, aside};
    renderer.set_transforms(transforms);
    renderer.render(1);
    EXPECT_NEAR(at(renderer.map("colour"), 24 * 64 + 32).y, 1.0, 1e-6);
}

TEST(Layers, ASceneOfNothingElseIsSeenThrough) {
    scene::Scene scene = panes({{5, {1, 0, 0}, 0.5f}});
    scene.meshes[0].triangle_material.assign(4, 1);
    scene.background = {0, 1, 0};
    render::Renderer renderer(device(), scene, options(4));
    renderer.render(0);
    const glm::dvec3 colour = at(renderer.map("colour"), 24 * 64 + 32);
    EXPECT_LT(glm::length(colour - glm::dvec3(0.75, 0.25, 0.0)), 1e-6); // both panes glow
}

TEST(Layers, AddNoStageWhereNothingIsBlended) {
    const scene::Scene scene = scene::load("cornell");
    EXPECT_FALSE(frame::split_blended(scene).has_value());
    render::Renderer renderer(device(), scene, options(4));
    EXPECT_THAT(renderer.explain(), Not(HasSubstr("layer")));
}

TEST(Layers, OutOfRangeIsAnError) {
    for (const std::uint32_t layers : {0u, 17u})
        EXPECT_THAT([&] { render::Renderer(device(), scene::load("cornell"), options(layers)); },
                    ThrowsMessage<std::invalid_argument>(HasSubstr("layers")));
}

} // namespace
