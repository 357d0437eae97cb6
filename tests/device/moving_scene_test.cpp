// Scenes in motion: a frame is that of the same things placed by hand, and its motion that since
// the frame before.
#include <cstring>

#include <gtest/gtest.h>

#include "scenes/load.hpp"
#include "scenes/mover.hpp"
#include "tests/support/moving_scenes.hpp"

namespace {
using namespace macula;
using namespace macula::test;

compute::Device& device() {
    static compute::Device opened = compute::open();
    return opened;
}

render::Options options(std::uint32_t width = 96, std::uint32_t height = 72) {
    render::Options o;
    o.width = width;
    o.height = height;
    return o;
}

// The scene in which nothing moves any more, with its instances where they are in this frame.
scene::Scene still(scene::Scene scene, std::uint32_t frame) {
    const scene::Scene moving = scene;
    scene::Mover mover(moving);
    const auto transforms = mover.at(frame, {});
    for (std::size_t i = 0; i < transforms.size(); ++i)
        scene.instances[i].world_from_object = transforms[i];
    scene.motion = {};
    return scene;
}

// A texture of opaque and transparent texels in a chequered pattern.
scene::Texture holes() {
    scene::Texture texture{"holes", {{2, 2, {}}, {1, 1, {}}}, true, {}, {}, true};
    for (int i = 0; i < 4; ++i)
        texture.levels[0].rgba.insert(texture.levels[0].rgba.end(),
                                      {200, 80, 40, std::uint8_t(i % 3 == 0 ? 255 : 0)});
    texture.levels[1].rgba = {200, 80, 40, 128};
    return texture;
}

// A wall; before it a ball with holes, a translucent pane and a mirror go their ways.
scene::Scene three_ways() {
    scene::Scene scene = panel_before_a_wall(-6.0f);
    scene.textures.push_back(holes());
    scene.materials.resize(7, scene.materials[0]);
    scene.materials[4].diffuse_texture = 0;
    scene.materials[4].alpha_mode = scene::AlphaMode::mask;
    scene.materials[5].alpha_mode = scene::AlphaMode::blend;
    scene.materials[5].opacity = 0.5f;
    scene.materials[6].reflectivity = glm::vec3(0.8f);
    const auto add = [&](scene::Mesh mesh, std::uint32_t material, glm::vec3 from, glm::vec3 to) {
        mesh.triangle_material.assign(mesh.triangles.size(), material);
        for (const glm::vec3& p : mesh.positions)
            mesh.uvs.emplace_back(2.0f * p.x, 2.0f * p.y);
        scene::MotionNode& node = scene.motion.nodes.emplace_back();
        node.translation.frames = {0.0f, 64.0f};
        node.translation.values = {from, to};
        node.rest.scale = glm::vec3(0.75f);
        const auto last = static_cast<std::uint32_t>(scene.motion.nodes.size() - 1);
        scene.motion.instances.push_back(
            {static_cast<std::uint32_t>(scene.instances.size()), last, glm::mat4(1.0f)});
        scene.instances.push_back({static_cast<std::uint32_t>(scene.meshes.size()), {}, "moving"});
        scene.meshes.push_back(std::move(mesh));
    };
    add(icosphere(2), 4, {-1, 1, -5}, {1, 0.5f, -5});
    add(icosphere(1), 5, {1, -1, -4}, {-1, 0, -4});
    add(icosphere(2), 6, {2, 1, -7}, {0, -1, -6});
    scene::Light light;
    light.position = {3, 4, 2};
    light.colour = glm::vec3(0.6f);
    light.radius = 0.5f;
    scene.lights.push_back(light);
    scene::validate(scene);
    return scene;
}

// Linear keys whose values and times are powers of two: the pose is exact, and closed.
TEST(MovingScene, EachFrameIsThatOfTheInstancesPlacedInClosedForm) {
    const scene::Scene scene = three_ways();
    for (const auto lights : {frame::LightMode::point, frame::LightMode::area}) {
        render::Options o = options();
        o.lights = lights;
        render::Renderer moving(device(), scene, o);
        for (const std::uint32_t frame : {0u, 1u, 2u, 16u, 64u, 99u}) {
            scene::Scene placed = scene;
            placed.motion = {};
            const float t = std::min(static_cast<float>(frame) / 64.0f, 1.0f);
            for (const scene::MovedInstance& moved : scene.motion.instances) {
                const auto& keys = scene.motion.nodes[moved.node].translation.values;
                scene::Transform place = moved_by(keys[0] * (1.0f - t) + keys[1] * t);
                for (int i = 0; i < 3; ++i)
                    place.row[i][i] = 0.75f;
                placed.instances[moved.instance].world_from_object = place;
            }
            moving.render(frame);
            render::Renderer standing(device(), placed, o);
            standing.render(frame);
            EXPECT_EQ(moving.hash(), standing.hash()) << "frame " << frame;
        }
    }
}

TEST(MovingScene, TheBuiltInOneIsItsStandingSelfInEachFrame) {
    const scene::Scene scene = scene::load("whitted_moving");
    render::Renderer moving(device(), scene, options());
    std::string last;
    for (const std::uint32_t frame : {0u, 1u, 77u}) {
        render::Renderer standing(device(), still(scene, frame), options());
        moving.render(frame);
        standing.render(frame);
        EXPECT_EQ(moving.hash(), standing.hash()) << "frame " << frame;
        EXPECT_NE(moving.hash(), last);
        last = moving.hash();
    }
}

// The panel goes to the right by one pixel a frame.
scene::Scene panel_on_its_way(std::uint32_t height) {
    scene::Scene scene = panel_before_a_wall(-6.0f);
    const float pixel = 2.0f * 6.0f * std::tan(glm::radians(30.0f)) / static_cast<float>(height);
    scene::MotionNode& node = scene.motion.nodes.emplace_back();
    node.translation.frames = {0.0f, 64.0f};
    node.translation.values = {{-32.0f * pixel, 0, 0}, {32.0f * pixel, 0, 0}};
    scene.motion.instances.push_back({1, 0, glm::mat4(1.0f)});
    place_instances(scene, 0.0f);
    return scene;
}

// The motion in pixels of the panel's columns; all its pixels move alike, and nothing else does.
float motion_of_panel(const render::Renderer& renderer) {
    const render::Image motion = renderer.map("motion"), material = renderer.map("material");
    float found = NAN;
    for (std::uint32_t i = 0; i < pixels(motion); ++i) {
        const glm::dvec3 m = at(motion, i);
        EXPECT_NEAR(m.y, 0.0, 2e-3);
        if (material.words[i] < 2) {
            EXPECT_NEAR(m.x, 0.0, 2e-3);
            continue;
        }
        if (std::isnan(found))
            found = static_cast<float>(m.x);
        EXPECT_NEAR(m.x, found, 4e-3);
    }
    return found;
}

render::Options with_motion() {
    render::Options o = options();
    o.images = {"motion", "material"};
    return o;
}

TEST(MovingScene, MotionIsThatSinceTheFrameRenderedBefore) {
    render::Renderer renderer(device(), panel_on_its_way(72), with_motion());
    std::uint32_t last = 20;
    for (const std::uint32_t frame : {20u, 21u, 24u, 24u, 25u, 22u}) {
        renderer.render(frame);
        EXPECT_NEAR(motion_of_panel(renderer), static_cast<float>(last) - static_cast<float>(frame),
                    4e-3f)
            << "frame " << frame;
        last = frame;
    }
}

TEST(MovingScene, NothingMovesInTheFrameAfterAReset) {
    render::Renderer renderer(device(), panel_on_its_way(72), with_motion());
    for (const std::uint32_t frame : {20u, 23u}) {
        renderer.render(frame);
        renderer.reset();
    }
    renderer.render(30);
    EXPECT_NEAR(motion_of_panel(renderer), 0.0f, 2e-3f);
    renderer.render(31);
    EXPECT_NEAR(motion_of_panel(renderer), -1.0f, 4e-3f);
}

TEST(MovingScene, TwoViewsShareOneMotionAndBeginAnewTogether) {
    const scene::Scene scene = panel_on_its_way(72);
    const auto shared = std::make_shared<render::DeviceScene>(device(), scene);
    render::Renderer left(shared, scene, with_motion()), right(shared, scene, with_motion());
    const auto expect_motion = [&](std::uint32_t frame, float expected) {
        for (render::Renderer* view : {&left, &right}) {
            view->render(frame);
            EXPECT_NEAR(motion_of_panel(*view), expected, 4e-3f) << "frame " << frame;
        }
        EXPECT_EQ(left.hash(), right.hash());
    };
    expect_motion(10, 0.0f);
    expect_motion(13, -3.0f);
    left.reset();
    right.reset();
    expect_motion(20, 0.0f);
    expect_motion(21, -1.0f);
}

TEST(MovingScene, ViewsThatFlyOneAfterTheOtherSeeTheirOwnFrames) {
    const scene::Scene scene = panel_on_its_way(72);
    const auto shared = std::make_shared<render::DeviceScene>(device(), scene);
    render::Renderer first(shared, scene, options()), second(shared, scene, options());
    render::Renderer alone(device(), scene, options());
    for (std::uint32_t frame = 10; frame < 15; ++frame)
        first.render(frame);
    for (std::uint32_t frame = 10; frame < 13; ++frame) {
        second.render(frame);
        alone.render(frame);
        EXPECT_EQ(second.hash(), alone.hash()) << "frame " << frame;
    }
}

} // namespace
