// The laws of physics::World: with exact contacts everywhere it is plain Bullet, it repeats to the
// bit, and no sphere goes deeper than the bound, checked against every triangle.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "scenes/load.hpp"
#include "scenes/physics/distance.hpp"
#include "scenes/physics/world.hpp"

namespace macula::scene::physics {
namespace {

constexpr Observer kFarGaze{{0.0f, 3.6f, 9.0f}, {0.0f, 0.0f, 1.0f}};       // behind the eye's back
constexpr Observer kNearGaze{{0.0f, 3.6f, 9.0f}, {0.0f, -0.25f, -0.968f}}; // at the knot

Scene scene_with(float exact_degrees, std::uint32_t coarsest = 7) {
    Scene scene = load("spheres");
    scene.physics->acuity.exact_degrees = exact_degrees;
    scene.physics->acuity.coarsest_level = coarsest;
    return scene;
}

std::vector<Transform> transforms(const World& world) {
    std::vector<Transform> all;
    for (std::size_t i = 0; i < world.spheres(); ++i)
        all.push_back(world.transform(i));
    return all;
}

glm::vec3 centre(const World& world, std::size_t i) {
    return world.transform(i).apply(glm::vec3(0.0f));
}

// Of all obstacles, in world space.
std::vector<Triangle> triangles_of(const Scene& scene) {
    std::vector<Triangle> all;
    for (const std::uint32_t index : scene.physics->obstacles) {
        const Instance& instance = scene.instances[index];
        const Mesh& mesh = scene.meshes[instance.mesh];
        const auto at = [&](std::uint32_t vertex) {
            return instance.world_from_object.apply(mesh.positions[vertex]);
        };
        for (const glm::uvec3& t : mesh.triangles)
            all.push_back({at(t.x), at(t.y), at(t.z)});
    }
    return all;
}

TEST(PhysicsWorld, ExactEverywhereIsPlainBulletToTheBitFor1000Frames) {
    const Scene scene = scene_with(180.0f);
    World ours(scene), plain(scene, Contacts::plain);
    for (int frame = 1; frame <= 1000; ++frame) {
        ours.step(frame % 2 == 0 ? kFarGaze : kNearGaze);
        plain.step(kFarGaze);
        ASSERT_EQ(transforms(ours), transforms(plain)) << "frame " << frame;
    }
}

TEST(PhysicsWorld, CoarseContactsDifferFromExactOnes) {
    World coarse(scene_with(5.0f)), exact(scene_with(180.0f));
    for (int frame = 0; frame < 60; ++frame) {
        coarse.step(kFarGaze);
        exact.step(kFarGaze);
    }
    EXPECT_NE(transforms(coarse), transforms(exact));
}

TEST(PhysicsWorld, RestartAndASecondWorldRepeatToTheBit) {
    const Scene scene = scene_with(5.0f);
    World first(scene), second(scene);
    const auto run = [](World& world) {
        for (int frame = 0; frame < 300; ++frame)
            world.step(frame / 40 % 2 == 0 ? kFarGaze : kNearGaze);
        return transforms(world);
    };
    const std::vector<Transform> once = run(first);
    first.restart();
    EXPECT_EQ(first.frame(), 0u);
    EXPECT_EQ(run(first), once);
    EXPECT_EQ(run(second), once);
}

TEST(PhysicsWorld, PenetrationIsThatOfBruteForceAndWithinTheBound) {
    const Scene scene = scene_with(5.0f);
    const std::vector<Triangle> triangles = triangles_of(scene);
    World world(scene);
    const float radius = scene.physics->radius;
    for (int frame = 1; frame <= 400; ++frame) {
        world.step(frame / 30 % 2 == 0 ? kFarGaze : kNearGaze);
        const std::size_t i = static_cast<std::size_t>(frame) % world.spheres();
        float nearest = radius;
        for (const Triangle& t : triangles)
            nearest = std::min(nearest,
                               glm::length(nearest_point(t, centre(world, i)) - centre(world, i)));
        EXPECT_NEAR(world.penetration(i), radius - nearest, 1e-4f * radius);
        for (std::size_t k = 0; k < world.spheres(); ++k)
            ASSERT_LE(world.penetration(k), world.penetration_bound()) << frame << " " << k;
    }
}

} // namespace
} // namespace macula::scene::physics
