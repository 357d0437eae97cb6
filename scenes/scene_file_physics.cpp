#include "scenes/scene_file_physics.hpp"

#include <algorithm>
#include <string>

#include "scenes/physics/rain.hpp"
#include "scenes/procedural/kit.hpp"

namespace macula::scene {
namespace {

constexpr double kFar = 1e9;                  // of lengths and speeds
constexpr std::int64_t kMostSpheres = 10'000; // of a frame that is still one

// A new one of that name where the scene has none; [[material]] tables can then change it.
std::uint32_t material_called(const std::string& name, Scene& scene) {
    const auto found = std::find_if(scene.materials.begin(), scene.materials.end(),
                                    [&](const Material& m) { return m.name == name; });
    if (found != scene.materials.end())
        return static_cast<std::uint32_t>(found - scene.materials.begin());
    Material material;
    material.name = name;
    scene.materials.push_back(material);
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

// A square about the middle of what is there.
void add_ground(const TomlTable& table, Scene& scene) {
    const float height = table.required_number("ground", -kFar, kFar);
    const Bounds bounds = scene.bounds();
    const float half =
        0.5f * table.number("ground_size", 1e-9, kFar).value_or(4.0f * bounds.diagonal());
    const glm::vec3 middle = 0.5f * (bounds.lo + bounds.hi);
    procedural::MeshBuilder b("ground");
    b.face({{middle.x - half, height, middle.z + half},
            {middle.x + half, height, middle.z + half},
            {middle.x + half, height, middle.z - half},
            {middle.x - half, height, middle.z - half}},
           {material_called("ground", scene), half});
    scene.meshes.push_back(b.take());
    scene.instances.push_back(
        {static_cast<std::uint32_t>(scene.meshes.size() - 1), Transform{}, "ground"});
}

CollisionAcuity read_acuity(const TomlTable& table) {
    CollisionAcuity acuity;
    acuity.exact_degrees = table.number("exact_degrees", 0.0, 180.0).value_or(acuity.exact_degrees);
    acuity.levels_per_degree =
        table.number("levels_per_degree", 0.0, 100.0).value_or(acuity.levels_per_degree);
    acuity.coarsest_level = static_cast<std::uint32_t>(
        table.integer("coarsest_level", 0, 100).value_or(acuity.coarsest_level));
    return acuity;
}

Physics read_bodies(const TomlTable& table) {
    Physics physics;
    physics.radius = table.required_number("radius", 1e-9, kFar);
    physics.gravity = table.vec3("gravity").value_or(physics.gravity);
    physics.frame_rate = table.number("frame_rate", 1.0, 1000.0).value_or(physics.frame_rate);
    physics.seed = static_cast<std::uint32_t>(table.integer("seed", 0, UINT32_MAX).value_or(0));
    physics.speed = table.number("speed", 0.0, kFar).value_or(physics.speed);
    physics.restitution = table.number("restitution", 0.0, 1.0).value_or(physics.restitution);
    physics.friction = table.number("friction", 0.0, 100.0).value_or(physics.friction);
    physics.reach = table.number("reach", 0.0, kFar).value_or(physics.reach);
    physics.acuity = read_acuity(table);
    return physics;
}

} // namespace

void read_physics(const TomlTable& table, Scene& scene) {
    if (!scene.motion.instances.empty() || scene.physics)
        table.fail("radius",
                   "something of the scene moves already: physics needs one that stands still");
    if (table.has("ground"))
        add_ground(table, scene);
    else if (table.has("ground_size"))
        table.fail("ground_size", "there is no 'ground'");
    physics::Rain rain;
    rain.count =
        static_cast<std::uint32_t>(table.integer("spheres", 1, kMostSpheres).value_or(rain.count));
    rain.centre = table.required_vec3("start");
    rain.spread = table.number("spread", 0.0, kFar).value_or(0.0f);
    for (const std::string& name : table.strings("materials"))
        rain.materials.push_back(material_called(name, scene));
    if (rain.materials.empty())
        rain.materials.push_back(material_called("sphere", scene));
    const Physics physics = read_bodies(table);
    table.reject_unknown();
    physics::add_rain(scene, rain, physics);
}

} // namespace macula::scene
