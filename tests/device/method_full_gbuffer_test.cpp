// The G-buffer of method `full` against positions, normals and motions known in closed form.
#include <cstring>

#include <gtest/gtest.h>

#include "host/cl/device.hpp"
#include "scenes/load.hpp"
#include "shared/ray.h"
#include "shared/surface.h"
#include "tests/support/small_scenes.hpp"

namespace {
using namespace macula;
using namespace macula::test;

compute::Device& device() {
    static compute::Device opened = compute::open();
    return opened;
}

render::Options options(std::vector<std::string> images) {
    render::Options o;
    o.width = 90;
    o.height = 70;
    o.images = std::move(images);
    return o;
}

struct Ray {
    glm::dvec3 origin, direction; // along the view axis by 1
};

// Through the middle of pixel i of a symmetric view without roll.
Ray ray_of(const View& view, std::uint32_t i, std::uint32_t width, std::uint32_t height) {
    const glm::dvec3 eye = view.eye;
    const glm::dvec3 forward = glm::normalize(glm::dvec3(view.target) - eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
    const glm::dvec3 up = glm::cross(right, forward);
    const double tangent = std::tan(double{view.fov} * std::numbers::pi / 360.0);
    const double x = (i % width + 0.5) / width * 2.0 - 1.0;
    const double y = 1.0 - (i / width + 0.5) / height * 2.0;
    return {eye, forward + right * (x * tangent * width / height) + up * (y * tangent)};
}

glm::dvec2 project(const View& view, glm::dvec3 p, std::uint32_t width, std::uint32_t height) {
    const glm::dvec3 forward = glm::normalize(glm::dvec3(view.target) - glm::dvec3(view.eye));
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
    const glm::dvec3 up = glm::cross(right, forward);
    const glm::dvec3 d = p - glm::dvec3(view.eye);
    const double tangent = std::tan(double{view.fov} * std::numbers::pi / 360.0);
    const double z = glm::dot(d, forward);
    const double x = glm::dot(d, right) / (z * tangent * width / height);
    const double y = glm::dot(d, up) / (z * tangent);
    return {(x + 1.0) / 2.0 * width, (1.0 - y) / 2.0 * height};
}

// The cube [-1, 1]^3; faces across x, y and z have materials 0, 1 and 2.
scene::Mesh cube() {
    scene::Mesh mesh;
    const glm::vec3 x{2, 0, 0}, y{0, 2, 0}, z{0, 0, 2};
    for (const float side : {1.0f, -1.0f}) {
        const glm::vec3 corner(-side);
        add_quad(mesh, corner, side * y, side * z, 0);
        add_quad(mesh, corner, side * z, side * x, 1);
        add_quad(mesh, corner, side * x, side * y, 2);
    }
    return mesh;
}

scene::Scene cube_scene(const View& view) {
    scene::Scene scene;
    scene.meshes.push_back(cube());
    scene.instances.push_back({0, {}, "cube"});
    scene.materials.resize(3);
    scene.materials[1].diffuse = {0.25f, 0.5f, 0.75f};
    scene.cameras.push_back({"test", view.eye, view.target, {0, 1, 0}, view.fov});
    scene::validate(scene);
    return scene;
}

TEST(GBuffer, OfACubeFromInsideIsItsSixPlanes) {
    const View view{{0.2f, -0.1f, 0.3f}, {1, 0.4f, -0.7f}, 100};
    render::Renderer renderer(device(), cube_scene(view),
                              options({"position", "depth", "geometric normal", "shading normal",
                                       "material", "triangle", "albedo"}));
    renderer.render(0);
    const render::Image position = renderer.map("position"), depth = renderer.map("depth");
    const render::Image normal = renderer.map("geometric normal");
    const render::Image shading = renderer.map("shading normal");
    const render::Image material = renderer.map("material"), triangle = renderer.map("triangle");
    const render::Image albedo = renderer.map("albedo");
    for (std::uint32_t i = 0; i < pixels(position); ++i) {
        const Ray ray = ray_of(view, i, position.width, position.height);
        glm::dvec3 t;
        for (int axis = 0; axis < 3; ++axis)
            t[axis] =
                (std::copysign(1.0, ray.direction[axis]) - ray.origin[axis]) / ray.direction[axis];
        const int axis = t.x < t.y ? (t.x < t.z ? 0 : 2) : (t.y < t.z ? 1 : 2);
        const glm::dvec3 expected = ray.origin + t[axis] * ray.direction;
        const glm::dvec3 found = at(position, i);
        EXPECT_NEAR(found.x, expected.x, 1e-5);
        EXPECT_NEAR(found.y, expected.y, 1e-5);
        EXPECT_NEAR(found.z, expected.z, 1e-5);
        EXPECT_NEAR(depth.floats[i], t[axis], 1e-5);
        glm::dvec3 inward(0.0);
        inward[axis] = -std::copysign(1.0, ray.direction[axis]);
        EXPECT_LT(glm::length(at(normal, i) - inward), 1e-6);
        EXPECT_LT(glm::length(at(shading, i) - inward), 1e-6);
        EXPECT_EQ(material.words[i], static_cast<std::uint32_t>(axis));
        const std::uint32_t first = (inward[axis] > 0 ? 0u : 6u) + 2u * axis;
        EXPECT_TRUE(triangle.words[i] == first || triangle.words[i] == first + 1);
        EXPECT_EQ(at(albedo, i).x, axis == 1 ? 0.25 : double{0.8f});
    }
}

// The published geometry: the back wall is z = 559.2.
TEST(GBuffer, OfTheCornellBoxHasItsBackWall) {
    const scene::Scene scene = scene::load("cornell");
    render::Options o = options({"position", "depth"});
    o.height = o.width;
    render::Renderer renderer(device(), scene, o);
    renderer.render(0, {"published", {278, 273, -800}, {278, 273, 0}, {0, 1, 0}, 39.3077f});
    const View view{{278, 273, -800}, {278, 273, 0}, 39.3077f};
    const render::Image position = renderer.map("position");
    int back_wall = 0;
    for (std::uint32_t i = 0; i < pixels(position); ++i) {
        const glm::dvec3 p = at(position, i);
        if (p.z < 559.0)
            continue;
        ++back_wall;
        const Ray ray = ray_of(view, i, position.width, position.height);
        const glm::dvec3 expected = ray.origin + ray.direction * (1359.2 / ray.direction.z);
        EXPECT_LT(glm::length(p - expected), 0.02) << i;
    }
    EXPECT_GT(back_wall, 500);
}

TEST(GBuffer, OfABackgroundPixelIsTheBackground) {
    scene::Mesh mesh;
    add_quad(mesh, {-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
    scene::Scene scene = scene_of(std::move(mesh), {{0, 1, 3}, {0, 5, 0}});
    scene.background = {0.1f, 0.2f, 0.3f};
    scene.ambient = glm::vec3(7.0f);
    render::Renderer renderer(device(), scene,
                              options({"position", "depth", "geometric normal", "material",
                                       "triangle", "albedo", "motion"}));
    renderer.render(0);
    const render::Image colour = renderer.map("colour");
    for (std::uint32_t i = 0; i < pixels(colour); ++i) {
        EXPECT_EQ(at(colour, i), glm::dvec3(0.1f, 0.2f, 0.3f));
        EXPECT_EQ(renderer.map("depth").floats[i], MACULA_BACKGROUND_DEPTH);
        EXPECT_EQ(renderer.map("triangle").words[i], MACULA_NO_TRIANGLE);
    }
    EXPECT_EQ(at(renderer.map("motion"), 5), glm::dvec3(0.0));
    EXPECT_EQ(at(renderer.map("albedo"), 5), glm::dvec3(0.0));
}

TEST(Motion, OfAViewThatStandsStillIsExactlyZero) {
    const View view{{0.2f, -0.1f, 0.3f}, {1, 0.4f, -0.7f}, 80};
    render::Renderer renderer(device(), cube_scene(view), options({"motion"}));
    for (std::uint32_t frame = 0; frame < 2; ++frame) {
        renderer.render(frame);
        for (const float value : renderer.map("motion").floats)
            ASSERT_EQ(value, 0.0f);
    }
}

TEST(Motion, OfATranslatedCameraIsThatOfTheProjection) {
    const View before{{0.2f, -0.1f, 0.3f}, {1, 0.4f, -0.7f}, 80};
    View now = before;
    now.eye += glm::vec3(0.05f, 0.02f, -0.03f);
    now.target += glm::vec3(0.05f, 0.02f, -0.03f);
    render::Renderer renderer(device(), cube_scene(before), options({"motion", "position"}));
    const auto camera = [](const View& v) {
        return scene::Camera{"test", v.eye, v.target, {0, 1, 0}, v.fov};
    };
    renderer.render(0, camera(before));
    renderer.render(1, camera(now));
    const render::Image motion = renderer.map("motion"), position = renderer.map("position");
    double moved = 0.0;
    for (std::uint32_t i = 0; i < pixels(motion); ++i) {
        const glm::dvec3 p = at(position, i);
        const glm::dvec2 expected = project(before, p, motion.width, motion.height) -
                                    project(now, p, motion.width, motion.height);
        ASSERT_NEAR(at(motion, i).x, expected.x, 2e-3);
        ASSERT_NEAR(at(motion, i).y, expected.y, 2e-3);
        moved += glm::length(expected);
    }
    EXPECT_GT(moved / pixels(motion), 0.5);
}

TEST(Motion, OfAMovingInstanceFollowsItsTransforms) {
    const View view{{0, 0, 5}, {0, 0, 0}, 40};
    const scene::Transform first = oblique(20, 1, {0.1f, 0, 0}),
                           second = oblique(35, 1, {0, 0.1f, 0});
    scene::Scene scene = scene_of(icosphere(1), view, first);
    render::Renderer renderer(device(), scene, options({"motion", "position", "triangle"}));
    renderer.render(0);
    renderer.set_transforms(std::vector{second});
    renderer.render(1);
    // p' = first (second^-1 p): the linear parts are rotations.
    const auto linear = [](const scene::Transform& t) {
        glm::dmat3 m;
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                m[column][row] = t.row[row][column];
        return m;
    };
    const auto offset = [](const scene::Transform& t) {
        return glm::dvec3(t.row[0].w, t.row[1].w, t.row[2].w);
    };
    int hits = 0;
    {
        const render::Image motion = renderer.map("motion"), position = renderer.map("position");
        const render::Image triangle = renderer.map("triangle");
        for (std::uint32_t i = 0; i < pixels(motion); ++i) {
            if (triangle.words[i] == MACULA_NO_TRIANGLE)
                continue;
            ++hits;
            const glm::dvec3 p = at(position, i);
            const glm::dvec3 object = glm::transpose(linear(second)) * (p - offset(second));
            const glm::dvec3 previous = linear(first) * object + offset(first);
            const glm::dvec2 expected = project(view, previous, motion.width, motion.height) -
                                        project(view, p, motion.width, motion.height);
            ASSERT_NEAR(at(motion, i).x, expected.x, 2e-3);
            ASSERT_NEAR(at(motion, i).y, expected.y, 2e-3);
        }
    }
    EXPECT_GT(hits, 500);
    // The frame after the last move stands still.
    renderer.render(2);
    for (const float value : renderer.map("motion").floats)
        ASSERT_EQ(value, 0.0f);
}

TEST(Motion, OfWhatWasBehindTheLastCameraIsMarked) {
    const View before{{0, 0, -3}, {0, 0, -9}, 60}, now{{0, 0, 3}, {0, 0, 0}, 20};
    render::Renderer renderer(device(), scene_of(icosphere(1), now), options({"motion"}));
    renderer.render(0, {"", before.eye, before.target, {0, 1, 0}, before.fov});
    renderer.render(1, {"", now.eye, now.target, {0, 1, 0}, now.fov});
    const render::Image motion = renderer.map("motion");
    EXPECT_EQ(at(motion, motion.width * (motion.height / 2) + motion.width / 2).x,
              MACULA_NO_MOTION);
}

// A mirrored, scaled and turned instance: normals by the inverse transpose, towards the viewer.
TEST(GBuffer, NormalsOfATransformedSphereAreThoseOfTheEllipsoid) {
    scene::Mesh mesh = icosphere(4);
    mesh.normals = mesh.positions;
    scene::Transform placed = oblique(30, 1, {0, 0, 0});
    const glm::vec3 scale(-0.5f, 1.0f, 1.5f);
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            placed.row[row][column] *= scale[column];
    const View view{{0.5f, 1, 6}, {0, 0, 0}, 35};
    render::Renderer renderer(device(), scene_of(std::move(mesh), view, placed),
                              options({"position", "shading normal", "triangle"}));
    renderer.render(0);
    const render::Image position = renderer.map("position");
    const render::Image normal = renderer.map("shading normal"),
                        triangle = renderer.map("triangle");
    glm::dmat3 linear;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            linear[column][row] = placed.row[row][column];
    const glm::dmat3 inverse = glm::inverse(linear);
    int hits = 0;
    for (std::uint32_t i = 0; i < pixels(position); ++i) {
        if (triangle.words[i] == MACULA_NO_TRIANGLE)
            continue;
        ++hits;
        const glm::dvec3 sphere = glm::normalize(inverse * at(position, i));
        const glm::dvec3 expected = glm::normalize(glm::transpose(inverse) * sphere);
        ASSERT_GT(glm::dot(at(normal, i), expected), 0.999);
        ASSERT_NEAR(glm::length(at(normal, i)), 1.0, 1e-6);
    }
    EXPECT_GT(hits, 500);
}

} // namespace
