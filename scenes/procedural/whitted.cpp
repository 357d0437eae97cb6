// The scene of Whitted, "An Improved Illumination Model for Shaded Display" (1980): a glass and a
// mirror-like sphere over a red and yellow checkerboard under a blue sky.
#include "scenes/procedural/whitted.hpp"

#include <vector>

#include "scenes/procedural/builtin.hpp"
#include "scenes/procedural/path.hpp"
#include "scenes/procedural/random.hpp"
#include "scenes/procedural/textures.hpp"

namespace macula::scene::procedural {
namespace {

std::uint32_t add_checks(Scene& scene) {
    const std::uint32_t texture = add_texture(scene, "checkerboard", {256, 256}, [](glm::vec2 uv) {
        const bool odd = (uv.x < 0.5f) != (uv.y < 0.5f);
        return Texel{odd ? rgb(0xe8c81e) : rgb(0xc4201c)};
    });
    return add_material(scene, "checkerboard", Maps{texture, kNoTexture});
}

} // namespace

std::uint32_t add_glass(Scene& scene) {
    Material glass;
    glass.name = "glass";
    glass.diffuse = glm::vec3{0.06f, 0.07f, 0.08f};
    glass.specular = glm::vec3{0.6f};
    glass.shininess = 200.0f;
    glass.index_of_refraction = 1.5f;
    glass.transmission = glm::vec3{0.85f};
    glass.reflectivity = glm::vec3{0.1f};
    scene.materials.push_back(glass);
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

std::uint32_t add_mirror(Scene& scene) {
    Material mirror;
    mirror.name = "mirror";
    mirror.diffuse = glm::vec3{0.22f, 0.24f, 0.27f};
    mirror.specular = glm::vec3{0.7f};
    mirror.shininess = 120.0f;
    mirror.reflectivity = glm::vec3{0.65f};
    scene.materials.push_back(mirror);
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

void add_board(MeshBuilder& b, Scene& scene) {
    // The board ends where the picture's did not show it. Cells of one unit, two to a repeat.
    constexpr float kHalfWidth = 6.0f, kNear = 9.0f, kFar = -19.0f;
    b.face({{-kHalfWidth, 0, kNear},
            {kHalfWidth, 0, kNear},
            {kHalfWidth, 0, kFar},
            {-kHalfWidth, 0, kFar}},
           {add_checks(scene), 2.0f});
}

void add_whitted_view(Scene& scene) {
    Light light;
    light.kind = LightKind::point;
    light.position = {-6.0f, 11.0f, 7.0f};
    light.colour = glm::vec3{0.95f};
    light.radius = 0.6f;
    scene.lights.push_back(light);
    scene.ambient = glm::vec3{0.22f};
    scene.background = linear_from_srgb(rgb(0x3a6fc4));
    scene.cameras.push_back({"classic", {0.2f, 2.0f, 7.2f}, {0.3f, 1.35f, 0.0f}, {0, 1, 0}, 42.0f});
}

CameraPath round_tour(float height, glm::vec2 mean, glm::vec2 dip) {
    constexpr int kPoints = 12;
    std::vector<Waypoint> waypoints;
    const glm::vec3 middle{0.6f, height, -0.1f};
    for (int i = 0; i < kPoints; ++i) {
        const float turn = static_cast<float>(i) / kPoints;
        const glm::vec2 round = sin_cos_turns(turn + 0.25f), wave = sin_cos_turns(2.0f * turn);
        const float distance = mean.x + dip.x * wave.x;
        const glm::vec3 eye{middle.x + distance * round.x, mean.y + dip.y * wave.y,
                            middle.z + distance * round.y};
        waypoints.push_back({eye, middle});
    }
    return fly_through(waypoints, true);
}

Scene make_whitted(const SceneParams&) {
    Scene scene;
    MeshBuilder b("whitted");
    add_board(b, scene);
    sphere(b, kGlassCentre, kGlassRadius, kSphereCells, {add_glass(scene), 1.0f});
    sphere(b, kMirrorCentre, kMirrorRadius, kSphereCells, {add_mirror(scene), 1.0f});
    scene.meshes.push_back(b.take());
    add_whitted_view(scene);
    scene.path = round_tour(1.3f, {5.2f, 2.1f}, {1.4f, 1.3f});
    return scene;
}

} // namespace macula::scene::procedural
