// The Cornell box as published: Cornell University Program of Computer Graphics, "Cornell Box Data"
// (1998), in millimetres. Reflectances and the lamp's spectrum as linear RGB, converted from the
// published spectra. The walls are those measured: not quite rectangular.
#include <array>

#include "scenes/procedural/builtin.hpp"
#include "scenes/procedural/kit.hpp"
#include "scenes/procedural/path.hpp"

namespace macula::scene::procedural {
namespace {

enum CornellMaterial : std::uint32_t { kWhite, kRed, kGreen, kLamp };

constexpr float kCeiling = 548.8f;

void add_materials(Scene& scene) {
    const auto matte = [&](const char* name, glm::vec3 reflectance) {
        Material material;
        material.name = name;
        material.diffuse = reflectance;
        scene.materials.push_back(material);
    };
    matte("white", {0.725f, 0.71f, 0.68f});
    matte("red", {0.63f, 0.065f, 0.05f});
    matte("green", {0.14f, 0.45f, 0.091f});
    matte("lamp", glm::vec3{0.78f});
    scene.materials[kLamp].emission = {17.0f, 12.0f, 4.0f};
}

// The ceiling around the lamp: four faces, since the lamp lies in the ceiling's plane.
void ceiling(MeshBuilder& b) {
    const glm::vec3 a{556.0f, kCeiling, 0.0f}, c{556.0f, kCeiling, 559.2f},
        d{0.0f, kCeiling, 559.2f}, e{0.0f, kCeiling, 0.0f};
    const glm::vec3 p{343.0f, kCeiling, 227.0f}, q{343.0f, kCeiling, 332.0f},
        r{213.0f, kCeiling, 332.0f}, s{213.0f, kCeiling, 227.0f};
    const Finish white{kWhite, 100.0f};
    b.face({a, c, q, p}, white);
    b.face({c, d, r, q}, white);
    b.face({d, e, s, r}, white);
    b.face({e, a, p, s}, white);
    b.face({p, q, r, s}, {kLamp, 100.0f});
}

void room(MeshBuilder& b) {
    b.face({{552.8f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 559.2f}, {549.6f, 0.0f, 559.2f}},
           {kWhite, 100.0f});
    ceiling(b);
    b.face({{549.6f, 0.0f, 559.2f},
            {0.0f, 0.0f, 559.2f},
            {0.0f, kCeiling, 559.2f},
            {556.0f, kCeiling, 559.2f}},
           {kWhite, 100.0f});
    b.face({{0.0f, 0.0f, 559.2f},
            {0.0f, 0.0f, 0.0f},
            {0.0f, kCeiling, 0.0f},
            {0.0f, kCeiling, 559.2f}},
           {kGreen, 100.0f});
    b.face({{552.8f, 0.0f, 0.0f},
            {549.6f, 0.0f, 559.2f},
            {556.0f, kCeiling, 559.2f},
            {556.0f, kCeiling, 0.0f}},
           {kRed, 100.0f});
}

// A block of this height on four base corners, counter-clockwise seen from above.
void standing_block(MeshBuilder& b, float height, const std::array<glm::vec2, 4>& base) {
    const auto at = [&](std::size_t i, float y) {
        return glm::vec3{base[i % 4].x, y, base[i % 4].y};
    };
    const Finish white{kWhite, 100.0f};
    b.face({at(0, height), at(1, height), at(2, height), at(3, height)}, white);
    for (std::size_t i = 0; i < 4; ++i)
        b.face({at(i, 0.0f), at(i + 1, 0.0f), at(i + 1, height), at(i, height)}, white);
}

// The lamp, the light in the room and the published camera: focal length 0.035, image 0.025 x
// 0.025.
Scene empty_box() {
    Scene scene;
    scene.metres_per_unit = 0.001f;
    add_materials(scene);
    Light lamp;
    lamp.kind = LightKind::rectangle;
    lamp.position = {278.0f, kCeiling - 0.25f, 279.5f};
    lamp.direction = {0.0f, -1.0f, 0.0f};
    lamp.edge_u = {130.0f, 0.0f, 0.0f};
    lamp.edge_v = {0.0f, 0.0f, 105.0f};
    lamp.colour = {1.6f, 1.13f, 0.377f};
    lamp.attenuation_distance = 350.0f;
    scene.lights.push_back(lamp);
    scene.ambient = glm::vec3{0.12f, 0.1f, 0.07f};
    scene.cameras.push_back({"published", {278, 273, -800}, {278, 273, 0}, {0, 1, 0}, 39.3077f});
    const std::array<Waypoint, 8> tour{{{{278, 273, -800}, {278, 273, 200}},
                                        {{180, 330, -350}, {300, 220, 300}},
                                        {{110, 360, 40}, {330, 150, 360}},
                                        {{120, 330, 260}, {420, 120, 200}},
                                        {{200, 430, 190}, {330, 180, 420}},
                                        {{370, 440, 150}, {150, 60, 330}},
                                        {{460, 260, 60}, {160, 100, 280}},
                                        {{430, 160, -300}, {270, 200, 280}}}};
    scene.path = fly_through(tour, true);
    return scene;
}

} // namespace

Scene make_cornell(const SceneParams&) {
    Scene scene = empty_box();
    MeshBuilder b("cornell_box");
    room(b);
    standing_block(b, 165.0f, {{{130, 65}, {82, 225}, {240, 272}, {290, 114}}});
    standing_block(b, 330.0f, {{{423, 247}, {265, 296}, {314, 456}, {472, 406}}});
    scene.meshes.push_back(b.take());
    return scene;
}

// The same box with a mirror on the left and a less reflective ball of glass on the right, as Mrad
// (2022, section 5.1.1) has it.
Scene make_cornell_spheres(const SceneParams&) {
    constexpr glm::ivec2 kCells{128, 64};
    Scene scene = empty_box();
    Material mirror, glass;
    mirror.name = "mirror";
    mirror.diffuse = glm::vec3{0.04f};
    mirror.specular = glm::vec3{0.5f};
    mirror.shininess = 200.0f;
    mirror.reflectivity = glm::vec3{0.9f};
    glass.name = "glass";
    glass.diffuse = glm::vec3{0.02f};
    glass.specular = glm::vec3{0.4f};
    glass.shininess = 200.0f;
    glass.reflectivity = glm::vec3{0.06f};
    glass.transmission = glm::vec3{0.9f};
    glass.index_of_refraction = 1.5f;
    const auto first = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.insert(scene.materials.end(), {mirror, glass});
    MeshBuilder b("cornell_spheres");
    room(b);
    sphere(b, {395.0f, 105.0f, 360.0f}, 105.0f, kCells, {first, 100.0f});
    sphere(b, {160.0f, 95.0f, 195.0f}, 95.0f, kCells, {first + 1, 100.0f});
    scene.meshes.push_back(b.take());
    return scene;
}

} // namespace macula::scene::procedural
