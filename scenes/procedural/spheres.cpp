// Fifty spheres, some of them mirrors, that rain on a trefoil knot of 5,000 triangles: our own
// counterpart of figure 13 of Smith et al. 2014.
#include <vector>

#include "scenes/physics/rain.hpp"
#include "scenes/procedural/builtin.hpp"
#include "scenes/procedural/kit.hpp"
#include "scenes/procedural/path.hpp"
#include "scenes/procedural/random.hpp"
#include "scenes/procedural/textures.hpp"

namespace macula::scene::procedural {
namespace {

constexpr int kStations = 160, kSides = 16;
constexpr float kTubeRadius = 0.42f, kKnotSize = 0.8f;
constexpr glm::vec3 kKnotCentre{0.0f, 1.15f, 0.0f};

// The trefoil, as a (2, 3) torus knot about the y axis; `t` in turns.
glm::vec3 trefoil(float t) {
    const glm::vec2 twice = sin_cos_turns(2.0f * t), thrice = sin_cos_turns(3.0f * t);
    const float out = 2.0f + thrice.x;
    return kKnotCentre + kKnotSize * glm::vec3(out * twice.x, 0.85f * thrice.y, out * twice.y);
}

void knot(MeshBuilder& b, std::uint32_t material) {
    constexpr float kNear = 1e-3f; // turns: for the direction by a difference
    std::vector<glm::vec3> points;
    std::vector<glm::vec2> uvs;
    for (int j = 0; j <= kStations; ++j) {
        // The last row is bit for bit the first one.
        const float t = static_cast<float>(j % kStations) / kStations;
        const glm::vec3 ahead = glm::normalize(trefoil(t + kNear) - trefoil(t - kNear));
        const glm::vec3 side = glm::normalize(glm::cross(ahead, {0, 1, 0}));
        const glm::vec3 up = glm::cross(side, ahead);
        for (int i = 0; i <= kSides; ++i) {
            const float turn = static_cast<float>(i % kSides) / kSides;
            const glm::vec2 round = sin_cos_turns(turn);
            points.push_back(trefoil(t) + kTubeRadius * (side * round.x + up * round.y));
            uvs.emplace_back(static_cast<float>(i) / kSides, static_cast<float>(j) / 8.0f);
        }
    }
    surface(b, {kSides + 1, kStations + 1, true, true}, points, uvs, material);
}

void add_ground(Scene& scene) {
    const std::uint32_t texture = add_texture(scene, "tiles", {256, 256}, [](glm::vec2 uv) {
        const bool odd = (uv.x < 0.5f) != (uv.y < 0.5f);
        return Texel{odd ? rgb(0xb9b2a4) : rgb(0x6f7a80)};
    });
    const std::uint32_t material = add_material(scene, "tiles", Maps{texture, kNoTexture});
    MeshBuilder b("ground");
    constexpr float kHalf = 14.0f;
    b.face({{-kHalf, 0, kHalf}, {kHalf, 0, kHalf}, {kHalf, 0, -kHalf}, {-kHalf, 0, -kHalf}},
           {material, 2.0f});
    scene.meshes.push_back(b.take());
}

std::uint32_t glossy(Scene& scene, const char* name, glm::vec3 colour, float mirror) {
    Material material;
    material.name = name;
    material.diffuse = linear_from_srgb(colour) * (1.0f - 0.8f * mirror);
    material.specular = glm::vec3{0.5f};
    material.shininess = 90.0f;
    material.reflectivity = glm::vec3{mirror};
    scene.materials.push_back(material);
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

CameraPath tour() {
    constexpr int kPoints = 12;
    std::vector<Waypoint> waypoints;
    for (int i = 0; i < kPoints; ++i) {
        const float turn = static_cast<float>(i) / kPoints;
        const glm::vec2 round = sin_cos_turns(turn + 0.25f), dip = sin_cos_turns(2.0f * turn);
        const float distance = 8.2f + 0.8f * dip.x;
        waypoints.push_back(
            {{distance * round.x, 3.6f + 1.1f * dip.y, distance * round.y}, {0.0f, 1.1f, 0.0f}});
    }
    return fly_through(waypoints, true);
}

} // namespace

Scene make_spheres(const SceneParams& params) {
    Scene scene;
    add_ground(scene);
    MeshBuilder b("knot");
    knot(b, glossy(scene, "knot", rgb(0xd9d2c3), 0.0f));
    scene.meshes.push_back(b.take());
    for (std::uint32_t i = 0; i < scene.meshes.size(); ++i)
        scene.instances.push_back({i, Transform{}, scene.meshes[i].name});

    physics::Rain rain;
    rain.centre = {0.0f, 3.2f, 0.0f};
    rain.spread = 1.9f;
    rain.materials = {
        glossy(scene, "mirror", rgb(0xc8ccd0), 0.75f), glossy(scene, "red", rgb(0xc0392b), 0.12f),
        glossy(scene, "brass", rgb(0xc9a13b), 0.45f), glossy(scene, "teal", rgb(0x1f8a84), 0.12f),
        glossy(scene, "white", rgb(0xe8e6e0), 0.05f)};
    Physics physics;
    physics.radius = 0.2f;
    physics.speed = 0.5f;
    physics.reach = 6.0f;
    physics.seed = fold_seed(params.seed);
    physics::add_rain(scene, rain, physics);

    Light light;
    light.position = {-5.0f, 10.0f, 6.0f};
    light.colour = glm::vec3{0.9f};
    light.radius = 0.6f;
    scene.lights.push_back(light);
    scene.ambient = glm::vec3{0.25f};
    scene.background = linear_from_srgb(rgb(0x6f9bd6));
    scene.cameras.push_back({"front", {0.0f, 3.6f, 9.0f}, {0.0f, 1.1f, 0.0f}, {0, 1, 0}, 42.0f});
    scene.path = tour();
    return scene;
}

} // namespace macula::scene::procedural
