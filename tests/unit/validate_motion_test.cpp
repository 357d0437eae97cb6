// What validate() says of key frames and physics that make no sense.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "scenes/mover.hpp"
#include "scenes/validate.hpp"

namespace macula::scene {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// Three instances of a triangle at distance 1 of the origin; the middle one moves.
Scene moving() {
    Scene scene;
    scene.name = "s";
    Mesh mesh;
    mesh.positions = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    mesh.triangle_material = {0};
    scene.meshes.push_back(mesh);
    for (const char* name : {"a", "b", "c"})
        scene.instances.push_back({0, {}, name});
    MotionNode node;
    node.translation.frames = {0, 10};
    node.translation.values = {{1, 2, 3}, {4, 5, 6}};
    scene.motion.nodes = {node, node};
    scene.motion.nodes[1].parent = 0;
    scene.motion.instances.push_back({1, 1, glm::mat4(1.0f)});
    return scene;
}

Scene falling() {
    Scene scene = moving();
    scene.physics.emplace();
    scene.physics->radius = 1.0f;
    scene.physics->spheres = {0};
    scene.physics->obstacles = {2};
    return scene;
}

template <typename Change>
std::string error_of(Scene scene, Change&& change) {
    change(scene);
    try {
        validate(scene);
    } catch (const SceneError& error) {
        return error.what();
    }
    ADD_FAILURE() << "the scene was accepted";
    return {};
}

TEST(ValidateMotion, PlacesWhatMovesWhereItBegins) {
    Scene scene = moving();
    validate(scene);
    EXPECT_EQ(scene.instances[1].world_from_object.apply({}), glm::vec3(2, 4, 6));
    EXPECT_TRUE(scene.instances[0].world_from_object.is_identity());
}

TEST(ValidateMotion, BringsRotationsToUnitLengthButNotTangents) {
    Scene scene = moving();
    Track<glm::quat>& rotation = scene.motion.nodes[0].rotation;
    rotation.interpolation = Interpolation::cubic;
    rotation.frames = {0};
    rotation.values = {{3, 0, 0, 0}, {0, 0, 2, 0}, {0, 0, 0, 5}};
    validate(scene);
    EXPECT_EQ(scene.motion.nodes[0].rotation.values,
              (std::vector<glm::quat>{{3, 0, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 5}}));
}

TEST(ValidateMotion, EmptyMeshesAreLeftOutAndTheOthersGoOnMoving) {
    Scene scene = falling();
    scene.meshes.emplace(scene.meshes.begin());
    for (Instance& instance : scene.instances)
        instance.mesh = 1;
    scene.instances.insert(scene.instances.begin(), {0, {}, "empty"});
    scene.motion.instances[0].instance = 2;
    scene.motion.instances.push_back({0, 0, glm::mat4(1.0f)});
    scene.physics->spheres = {1};
    scene.physics->obstacles = {3, 0};
    EXPECT_NE(error_of(scene, [](Scene&) {}).find("obstacle 0 moves"), std::string::npos);
    scene.motion.instances.pop_back();
    validate(scene);
    ASSERT_EQ(scene.motion.instances.size(), 1u);
    EXPECT_EQ(scene.instances[scene.motion.instances[0].instance].name, "b");
    EXPECT_EQ(scene.physics->spheres, std::vector<std::uint32_t>{0});
    EXPECT_EQ(scene.physics->obstacles, std::vector<std::uint32_t>{2});
    EXPECT_EQ(moving_instances(scene), (std::vector<std::uint32_t>{0, 1}));
}

TEST(ValidateMotion, ErrorsSayWhichNodeOrInstance) {
    const auto motion_error = [](auto&& change) {
        return error_of(moving(), [&](Scene& s) { change(s.motion); });
    };
    EXPECT_EQ(motion_error([](Motion& m) { m.nodes[0].parent = 1; }),
              "s: moving node 0: its parent 1 is no node before it");
    EXPECT_EQ(motion_error([](Motion& m) { m.nodes[1].parent = 1; }),
              "s: moving node 1: its parent 1 is no node before it");
    EXPECT_EQ(motion_error([](Motion& m) { m.instances[0].instance = 3; }),
              "s: moving instance 3: there are 3");
    EXPECT_EQ(motion_error([](Motion& m) { m.instances[0].node = 2; }),
              "s: moving instance 1: node 2 of 2");
    EXPECT_EQ(motion_error([](Motion& m) { m.instances.push_back(m.instances[0]); }),
              "s: moving instance 1: it is moved twice");
    EXPECT_EQ(motion_error([](Motion& m) { m.instances[0].node_from_object[0][0] = 0.0f; }),
              "s: moving instance 1: its transform is not finite or singular");
    EXPECT_EQ(motion_error([](Motion& m) { m.period = -1.0f; }),
              "s: the period of its motion is no number of frames");
    EXPECT_EQ(motion_error([](Motion& m) { m.nodes[1].translation.values.pop_back(); }),
              "s: moving node 1: translation: 1 values for 2 key frames");
    EXPECT_EQ(motion_error([](Motion& m) { m.nodes[1].translation.frames[1] = 0.0f; }),
              "s: moving node 1: translation: key 1 is not after the one before");
    EXPECT_EQ(motion_error([](Motion& m) { m.nodes[1].translation.frames[0] = kNan; }),
              "s: moving node 1: translation: key 0 is at no finite frame");
    EXPECT_EQ(motion_error([](Motion& m) {
                  m.nodes[1].rest.rotation = {0, 0, 0, 0};
              }),
              "s: moving node 1: a rotation has no length");
    EXPECT_EQ(motion_error([](Motion& m) { m.nodes[1].rest.scale.z = 0.0f; }),
              "s: moving node 1: its scale becomes 0");
    EXPECT_EQ(motion_error([](Motion& m) { m.nodes[1].rest.translation.x = kNan; }),
              "s: moving node 1: its pose at rest is not finite");
}

TEST(ValidateMotion, ErrorsOfPhysics) {
    const auto physics_error = [](auto&& change) {
        return error_of(falling(), [&](Scene& s) { change(*s.physics); });
    };
    Scene scene = falling();
    EXPECT_NO_THROW(validate(scene));
    EXPECT_EQ(physics_error([](Physics& p) { p.spheres = {7}; }),
              "s: sphere 7 of physics: there are 3 instances");
    EXPECT_EQ(physics_error([](Physics& p) {
                  p.spheres = {0, 0};
              }),
              "s: sphere 0 of physics: it is moved twice");
    EXPECT_EQ(physics_error([](Physics& p) { p.spheres = {1}; }),
              "s: sphere 1 of physics: it is moved twice");
    EXPECT_EQ(physics_error([](Physics& p) { p.obstacles = {1}; }), "s: physics: obstacle 1 moves");
    EXPECT_EQ(physics_error([](Physics& p) { p.obstacles = {9}; }),
              "s: physics: obstacle 9 of 3 instances");
    EXPECT_EQ(physics_error([](Physics& p) { p.radius = 0.0f; }),
              "s: physics: the radius must be above 0");
    EXPECT_EQ(physics_error([](Physics& p) { p.radius = 2.0f; }),
              "s: sphere 0 of physics: its mesh is no sphere of radius 2.000000 about its origin");
    EXPECT_EQ(physics_error([](Physics& p) { p.frame_rate = 0.5f; }),
              "s: physics: the frame rate must lie between 1 and 1000");
    EXPECT_EQ(physics_error([](Physics& p) { p.gravity.y = kNan; }),
              "s: physics: gravity is not finite");
    EXPECT_EQ(physics_error([](Physics& p) { p.restitution = 1.5f; }),
              "s: physics: the restitution must lie between 0 and 1");
    EXPECT_EQ(
        error_of(falling(), [](Scene& s) { s.instances[0].world_from_object.row[0].x = 2.0f; }),
        "s: sphere 0 of physics: its transform must have the scale 1");
}

} // namespace
} // namespace macula::scene
