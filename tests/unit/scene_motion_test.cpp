// [motion] of scene files: poses against closed forms, and errors with file, line and key.
#include <cmath>
#include <numbers>

#include "scenes/mover.hpp"
#include "tests/support/scene_folder.hpp"

namespace macula::scene {
namespace {

class SceneMotion : public SceneFolder {
  protected:
    SceneMotion() { write("part.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"); }

    Scene load_toml(const std::string& text) const {
        return load_text("s.toml", "file = 'part.obj'\n" + text);
    }
    std::string error_of_toml(const std::string& text) const {
        return error_of_text("s.toml", "file = 'part.obj'\n" + text);
    }
};

// Where the object-space point p of instance 0 is in a frame.
glm::vec3 at(const Scene& scene, std::uint32_t frame, const glm::vec3& p = glm::vec3(0.0f)) {
    return Mover(scene).at(frame, {})[0].apply(p);
}

void expect_near(const glm::vec3& found, const glm::vec3& expected, float tolerance = 1e-5f) {
    EXPECT_LE(glm::length(found - expected), tolerance)
        << found.x << ' ' << found.y << ' ' << found.z;
}

glm::vec3 circle(float degrees) { // from +x about +y
    const float a = degrees * std::numbers::pi_v<float> / 180.0f;
    return {std::cos(a), 0.0f, -std::sin(a)};
}

TEST_F(SceneMotion, LinearKeysMoveInAStraightLineAndStandStillOutside) {
    const Scene scene = load_toml(R"(
[[motion.node]]
instances = "part"
key = [{frame = 10, translation = [1, 2, 3]}, {frame = 20, translation = [3, 2, -1]}]
)");
    expect_near(at(scene, 0), {1, 2, 3});
    expect_near(at(scene, 10), {1, 2, 3});
    expect_near(at(scene, 15), {2, 2, 1});
    expect_near(at(scene, 999), {3, 2, -1});
    EXPECT_EQ(moving_instances(scene), std::vector<std::uint32_t>{0});
    EXPECT_EQ(scene.instances[0].world_from_object, Mover(scene).at(0, {})[0]);
}

TEST_F(SceneMotion, WholeTurnsAboutAnAxisGoAllTheWayAndBeginAgain) {
    const Scene scene = load_toml(R"(
[motion]
period = 120
[[motion.node]]
instances = ["part"]
key = [{frame = 0, degrees = 0}, {frame = 120, degrees = 720}]
)");
    for (std::uint32_t frame = 0; frame < 300; frame += 7)
        expect_near(at(scene, frame, {1, 0, 0}), circle(6.0f * static_cast<float>(frame)), 1e-4f);
}

TEST_F(SceneMotion, QuaternionsTakeTheShortWay) {
    const Scene scene = load_toml(R"(
[[motion.node]]
instances = "part"
key = [
  {frame = 0, rotation = [0, 0, 0, 1]},
  {frame = 8, rotation = [0, -0.70710678, 0, -0.70710678]},
]
)");
    expect_near(at(scene, 4, {1, 0, 0}), circle(45.0f));
}

TEST_F(SceneMotion, StepsHoldTheirValueUntilTheNextKey) {
    const Scene scene = load_toml(R"(
[[motion.node]]
instances = "part"
interpolation = "step"
key = [{frame = 0, scale = 2}, {frame = 5, scale = [3, 1, 1], degrees = 360}]
)");
    expect_near(at(scene, 4, {1, 1, 0}), {2, 2, 0});
    expect_near(at(scene, 5, {1, 1, 0}), {3, 1, 0});
}

// The Catmull-Rom value halfway between the second and the third of four points of equal distance:
// (-a + 9 b + 9 c - d) / 16.
TEST_F(SceneMotion, SmoothKeysAreACatmullRomSpline) {
    const Scene scene = load_toml(R"(
[[motion.node]]
instances = "part"
interpolation = "smooth"
key = [
  {frame = 0, translation = [0, 0, 0]}, {frame = 10, translation = [4, 0, 0]},
  {frame = 20, translation = [4, 8, 0]}, {frame = 30, translation = [-2, 8, 6]},
]
)");
    expect_near(at(scene, 10), {4, 0, 0});
    expect_near(at(scene, 15), glm::vec3(9 * 4 + 9 * 4 + 2, 9 * 8 - 8, -6) / 16.0f);
}

TEST_F(SceneMotion, ASmoothRoundPassesItsEndWithoutAKink) {
    const Scene scene = load_toml(R"(
[motion]
period = 40
[[motion.node]]
instances = "part"
interpolation = "smooth"
key = [
  {frame = 0, translation = [1, 0, 0]}, {frame = 10, translation = [0, 1, 0]},
  {frame = 20, translation = [-1, 0, 0]}, {frame = 30, translation = [0, -1, 0]},
  {frame = 40, translation = [1, 0, 0]},
]
)");
    const glm::vec3 before = at(scene, 40) - at(scene, 39), after = at(scene, 41) - at(scene, 40);
    EXPECT_LT(glm::length(before - after), 0.5f * glm::length(before));
    EXPECT_GT(before.y, 0.9f * glm::length(before));
}

TEST_F(SceneMotion, ParentsCarryTheirChildrenAndAPivotStaysInPlace) {
    const Scene scene = load_toml(R"(
[[motion.node]]
name = "arm"
translation = [10, 0, 0]
key = [{frame = 0, degrees = 0}, {frame = 90, degrees = 90}]
[[motion.node]]
parent = "arm"
pivot = [1, 0, 0]
instances = "part"
key = [{frame = 0, degrees = 0}, {frame = 90, degrees = 90}]
)");
    for (const std::uint32_t frame : {0u, 30u, 90u}) {
        const auto degrees = static_cast<float>(frame);
        const glm::vec3 pivot = glm::vec3(10, 0, 0) + circle(degrees);
        expect_near(at(scene, frame, {1, 0, 0}), pivot);
        expect_near(at(scene, frame, {2, 0, 0}), pivot + circle(2.0f * degrees));
    }
}

TEST_F(SceneMotion, UpAxisAndScaleOfAnOuterFileCarryTheMotionAlong) {
    write("inner.toml", R"(file = 'part.obj'
[[motion.node]]
instances = "part"
key = [
  {frame = 0, translation = [1, 2, 3], degrees = 30, axis = [0, 0, 1]},
  {frame = 9, degrees = 90, scale = 2, axis = [1, 0, 0]},
]
)");
    const Scene inner = load_written("inner.toml");
    for (const char* up : {"x", "z"}) {
        const Scene outer = load_text("outer.toml", "file = 'inner.toml'\nscale = 3.0\nup = '" +
                                                        std::string(up) + "'\n");
        for (const std::uint32_t frame : {0u, 5u, 9u})
            for (const glm::vec3& p : {glm::vec3(0), glm::vec3(1, 2, 3), glm::vec3(-1, 0, 1)}) {
                const glm::vec3 w = 3.0f * at(inner, frame, p);
                expect_near(at(outer, frame, p),
                            *up == 'z' ? glm::vec3(w.y, w.z, w.x) : glm::vec3(w.z, w.x, w.y),
                            1e-4f);
            }
    }
}

TEST_F(SceneMotion, AnInstanceMovesOnceThroughAllFiles) {
    write("inner.toml", R"(file = 'part.obj'
[[motion.node]]
translation = [5, 0, 0]
instances = "part"
)");
    EXPECT_EQ(error_of_text("s.toml", "file = 'inner.toml'\n[[motion.node]]\ninstances = 'part'\n"),
              path("s.toml") + ":3: key 'instances': 'part' moves already");
}

TEST_F(SceneMotion, ErrorsNameFileLineAndKey) {
    const std::string file = path("s.toml");
    const auto node = [&](const std::string& lines) {
        return error_of_toml("[[motion.node]]\ninstances = 'part'\n" + lines);
    };
    EXPECT_EQ(error_of_toml("[[motion.node]]\ninstances = 'wheel'\n"),
              file + ":3: key 'instances': the scene has no instance 'wheel'; it has 'part'");
    EXPECT_EQ(error_of_toml("[[motion.node]]\nparent = 'a'\n"),
              file + ":3: key 'parent': no node before this one is called 'a'");
    EXPECT_EQ(error_of_toml("[[motion.node]]\nname = 'a'\n[[motion.node]]\nname = 'a'\n"),
              file + ":5: key 'name': there is a node 'a' already");
    EXPECT_EQ(node("[[motion.node]]\ninstances = 'part'\n"),
              file + ":5: key 'instances': 'part' moves already");
    EXPECT_EQ(node("key = [{frame = 1},\n{frame = 1}]\n"),
              file + ":5: key 'frame': it must be greater than that of the key before");
    EXPECT_EQ(node("key = [{frame = 1, scale = 0}]\n"),
              file + ":4: key 'scale': a size between 1e-09 and 1e+09 was expected");
    EXPECT_EQ(node("rotation = [0, 0, 0, 0]\n"), file + ":4: key 'rotation': it has no length");
    EXPECT_EQ(node("rotation = [0, 0, 1]\n"),
              file + ":4: key 'rotation': a quaternion [x, y, z, w] was expected");
    EXPECT_EQ(node("degrees = 3\nrotation = [0, 0, 0, 1]\n"),
              file + ":4: key 'degrees': there is 'rotation', too");
    EXPECT_EQ(node("axis = [0, 0, 0]\n"), file + ":4: key 'axis': it has no length");
    EXPECT_EQ(node("key = [{frame = 0, translation = [nan, 0, 0]}]\n"),
              file + ":4: key 'translation': three finite numbers [x, y, z] were expected");
    EXPECT_EQ(node("interpolation = 'cubic'\n"),
              file + ":4: key 'interpolation': 'cubic' is none of: step, linear, smooth");
    EXPECT_EQ(node("turn = 1\n"), file + ":4: key 'turn': there is no such key here");
    EXPECT_EQ(node("key = [{frame = 0, degree = 1}]\n"),
              file + ":4: key 'degree': there is no such key here");
    EXPECT_EQ(node("interpolation = 'smooth'\n"
                   "key = [{frame = 0, degrees = 0}, {frame = 9, degrees = 180}]\n"),
              file + ":5: key 'degrees': smooth keys turn by less than 180 degrees each");
    EXPECT_EQ(error_of_toml("[motion]\nperiod = -1\n"),
              file + ":3: key 'period': -1 is not between 0 and 1e+07");
    EXPECT_EQ(error_of_toml("[motion]\nspeed = 1\n"),
              file + ":3: key 'speed': there is no such key here");
    EXPECT_EQ(node("key = [{frame = 0, scale = [1, 1, 1]}, {frame = 9, scale = [1, -1, 1]}]\n"),
              "part: moving node 0: its scale becomes 0");
}

} // namespace
} // namespace macula::scene
