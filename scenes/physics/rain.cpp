#include "scenes/physics/rain.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "scenes/procedural/kit.hpp"
#include "scenes/procedural/random.hpp"

namespace macula::scene::physics {
namespace {

constexpr glm::ivec2 kCells{32, 16};
constexpr std::uint32_t kPlaces = 0x5be7e5; // a stream of random numbers

std::uint32_t add_mesh(Scene& scene, float radius, std::uint32_t material) {
    procedural::MeshBuilder b("sphere");
    procedural::sphere(b, glm::vec3(0.0f), radius, kCells, {material, 1.0f});
    scene.meshes.push_back(b.take());
    return static_cast<std::uint32_t>(scene.meshes.size() - 1);
}

std::vector<glm::vec3> places(const Rain& rain, float radius, std::uint32_t seed) {
    constexpr float kApart = 2.6f, kLoose = 0.25f; // radii: neighbours never touch
    const float apart = kApart * radius;
    const auto fit = static_cast<std::uint32_t>(std::clamp(2.0f * rain.spread / apart, 0.0f, 1e3f));
    const std::uint32_t side = fit + 1;
    const float first = -0.5f * apart * static_cast<float>(fit);
    procedural::Random random(seed, kPlaces);
    std::vector<glm::vec3> all;
    for (std::uint32_t i = 0; i < rain.count; ++i) {
        const std::uint32_t column = i % side, row = i / side % side, layer = i / (side * side);
        glm::vec3 off;
        for (int axis = 0; axis < 3; ++axis)
            off[axis] = random.symmetric(kLoose * radius);
        const glm::vec3 cell(first + apart * static_cast<float>(column),
                             apart * static_cast<float>(layer),
                             first + apart * static_cast<float>(row));
        all.push_back(rain.centre + cell + off);
    }
    return all;
}

} // namespace

void add_rain(Scene& scene, const Rain& rain, Physics physics) {
    physics.obstacles.resize(scene.instances.size());
    std::iota(physics.obstacles.begin(), physics.obstacles.end(), 0u);
    std::vector<std::uint32_t> meshes;
    for (const std::uint32_t material : rain.materials)
        meshes.push_back(add_mesh(scene, physics.radius, material));
    physics.spheres.clear();
    for (const glm::vec3& at : places(rain, physics.radius, physics.seed)) {
        const std::size_t i = physics.spheres.size();
        Transform transform;
        for (int row = 0; row < 3; ++row)
            transform.row[row].w = at[row];
        physics.spheres.push_back(static_cast<std::uint32_t>(scene.instances.size()));
        scene.instances.push_back(
            {meshes[i % meshes.size()], transform, "sphere " + std::to_string(i)});
    }
    scene.physics = std::move(physics);
}

} // namespace macula::scene::physics
