// Small scenes on which every traversal variant is held to the CPU reference.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "scenes/procedural/registry.hpp"
#include "scenes/scene.hpp"

namespace macula::test {

class Random {
  public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    float operator()(float lo, float hi) {
        return lo + (hi - lo) * (static_cast<float>(engine_() >> 8) * 0x1p-24f);
    }
    glm::vec3 point(float lo, float hi) {
        const float x = (*this)(lo, hi), y = (*this)(lo, hi), z = (*this)(lo, hi);
        return {x, y, z};
    }

  private:
    std::mt19937 engine_;
};

inline void add_triangle(scene::Mesh& mesh, glm::vec3 a, glm::vec3 b, glm::vec3 c,
                         std::uint32_t material = 0) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c});
    mesh.uvs.insert(mesh.uvs.end(), {{0.0f, 0.0f}, {1.5f, -0.3f}, {-0.4f, 1.2f}});
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangle_material.push_back(material);
}

// Small triangles, large ones, needles, exact copies (ties) and degenerate ones in the cube of +-1.
inline scene::Mesh soup(std::uint32_t count, std::uint32_t seed, std::uint32_t materials) {
    Random random(seed);
    scene::Mesh mesh;
    for (std::uint32_t i = 0; i < count; ++i) {
        const float size = i % 16 == 0 ? 1.0f : 0.1f;
        const glm::vec3 a = random.point(-1, 1);
        const glm::vec3 b = a + random.point(-size, size);
        const glm::vec3 c =
            i % 8 == 3 ? b + random.point(-0.001f, 0.001f) : a + random.point(-size, size);
        add_triangle(mesh, a, b, c, i % materials);
        if (i % 10 == 0)
            add_triangle(mesh, a, b, c, (i + 1) % materials);
        if (i % 50 == 0)
            add_triangle(mesh, a, b, i % 100 == 0 ? a : 0.5f * (a + b));
    }
    return mesh;
}

// Material 0 is opaque, 1 is cut out by a checkerboard with a ragged edge, 2 lets all light pass.
inline void add_masked_materials(scene::Scene& scene) {
    scene::Texture checker{"checker",           {scene::MipLevel{37, 21, {}}}, true,
                           scene::Wrap::repeat, scene::Wrap::mirror,           true};
    for (std::uint32_t i = 0; i < 37 * 21; ++i) {
        const bool solid = (i % 37 / 4 + i / 37 / 3) % 2 == 0 && i % 11 != 0;
        checker.levels[0].rgba.insert(checker.levels[0].rgba.end(),
                                      {200, 100, 50, std::uint8_t(solid ? 255 : 90)});
    }
    scene::Texture clear{"clear",
                         {scene::MipLevel{1, 1, {0, 0, 0, 0}}},
                         true,
                         scene::Wrap::clamp,
                         scene::Wrap::clamp,
                         true};
    scene.textures = {checker, clear};
    scene.materials.resize(3);
    scene.materials[1].alpha_mode = scene::AlphaMode::mask;
    scene.materials[1].diffuse_texture = 0;
    scene.materials[2].alpha_mode = scene::AlphaMode::blend;
    scene.materials[2].diffuse_texture = 1;
}

inline scene::Transform random_transform(Random& random) {
    scene::Transform transform;
    for (glm::vec4& row : transform.row)
        row = glm::vec4(random.point(-0.6f, 0.6f), random(-3, 3));
    return transform;
}

inline scene::Scene soup_scene() {
    scene::Scene scene;
    scene.materials.resize(1);
    scene.meshes = {soup(3000, 1, 1)};
    scene.instances = {{0, {}, ""}};
    return scene;
}

inline scene::Scene masked_scene() {
    scene::Scene scene;
    add_masked_materials(scene);
    scene.meshes = {soup(1500, 2, 3), soup(500, 3, 1)};
    scene.instances = {{0, {}, ""}, {1, {}, ""}};
    return scene;
}

// Unmoved, rotated, mirrored, flattened and coincident instances.
inline scene::Scene instanced_scene() {
    Random random(4);
    scene::Scene scene;
    scene.materials.resize(1);
    scene.meshes = {soup(300, 5, 1), soup(200, 6, 1)};
    scene.instances = {{1, {}, ""}};
    for (std::uint32_t i = 0; i < 40; ++i)
        scene.instances.push_back({0, random_transform(random), ""});
    scene.instances.push_back(scene.instances[7]);
    scene::Transform flat;
    flat.row[1] = {0.0f, 1e-3f, 0.0f, 0.25f};
    scene.instances.push_back({0, flat, ""});
    scene.instances.push_back({0, {}, ""});
    return scene;
}

inline scene::Scene masked_instances_scene() {
    scene::Scene scene = instanced_scene();
    add_masked_materials(scene);
    scene.meshes[0] = soup(300, 5, 3);
    return scene;
}

// A lattice of unit squares in axis-parallel planes: rays can lie in its planes and meet its
// vertices and edges exactly.
inline scene::Scene lattice_scene() {
    scene::Scene scene;
    scene.materials.resize(1);
    scene::Mesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
        for (int plane = -2; plane <= 2; plane += 2) {
            for (int cell = 0; cell < 16; ++cell) {
                const auto at = [&](int x, int y) {
                    glm::vec3 p;
                    p[axis] = static_cast<float>(plane);
                    p[(axis + 1) % 3] = static_cast<float>(cell % 4 - 2 + x);
                    p[(axis + 2) % 3] = static_cast<float>(cell / 4 - 2 + y);
                    return p;
                };
                add_triangle(mesh, at(0, 0), at(1, 0), at(1, 1));
                add_triangle(mesh, at(0, 0), at(1, 1), at(0, 1));
            }
        }
    }
    scene.meshes = {mesh};
    scene.instances = {{0, {}, ""}};
    return scene;
}

// Thousands of copies of two triangles: no split separates them, and the lowest id must win.
inline scene::Scene coincident_scene() {
    scene::Scene scene;
    scene.materials.resize(1);
    scene::Mesh mesh;
    for (int i = 0; i < 3000; ++i) {
        add_triangle(mesh, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0});
        add_triangle(mesh, {-1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
    }
    scene.meshes = {mesh};
    scene.instances = {{0, {}, ""}};
    return scene;
}

inline scene::Scene whitted_scene() {
    return *scene::procedural::make("whitted", {});
}

} // namespace macula::test
