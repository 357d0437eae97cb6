// Scenes of a few triangles whose pictures are known in closed form.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "host/render/renderer.hpp"
#include "scenes/scene.hpp"
#include "scenes/validate.hpp"

namespace macula::test {

inline void add_triangle(scene::Mesh& mesh, const std::array<glm::vec3, 3>& corners,
                         std::uint32_t material = 0) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangle_material.push_back(material);
}

// The parallelogram origin + s * u + t * v.
inline void add_quad(scene::Mesh& mesh, glm::vec3 origin, glm::vec3 u, glm::vec3 v,
                     std::uint32_t material = 0) {
    add_triangle(mesh, {origin, origin + u, origin + u + v}, material);
    add_triangle(mesh, {origin, origin + u + v, origin + v}, material);
}

// A closed, convex polyhedron of 20 * 4^levels triangles with its corners on the unit sphere.
inline scene::Mesh icosphere(int levels) {
    const float g = std::numbers::phi_v<float>;
    scene::Mesh mesh;
    mesh.positions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                      {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    for (glm::vec3& p : mesh.positions)
        p = glm::normalize(p);
    mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                      {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                      {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                      {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [place, is_new] = middles.try_emplace(
                std::minmax(a, b), static_cast<std::uint32_t>(mesh.positions.size()));
            if (is_new)
                mesh.positions.push_back(glm::normalize(mesh.positions[a] + mesh.positions[b]));
            return place->second;
        };
        std::vector<glm::uvec3> finer;
        for (const glm::uvec3& t : mesh.triangles) {
            const std::uint32_t ab = middle(t.x, t.y), bc = middle(t.y, t.z), ca = middle(t.z, t.x);
            finer.insert(finer.end(), {{t.x, ab, ca}, {t.y, bc, ab}, {t.z, ca, bc}, {ab, bc, ca}});
        }
        mesh.triangles = std::move(finer);
    }
    mesh.triangle_material.assign(mesh.triangles.size(), 0);
    return mesh;
}

struct View {
    glm::vec3 eye, target;
    float fov = 60.0f;
};

// One placed mesh with a white material and black ambient light and background.
inline scene::Scene scene_of(scene::Mesh mesh, View view, const scene::Transform& placed = {}) {
    scene::Scene scene;
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back({0, placed, "thing"});
    scene.materials.emplace_back();
    scene.materials[0].diffuse = glm::vec3(1.0f);
    scene.ambient = glm::vec3(0.0f);
    scene.cameras.push_back({"test", view.eye, view.target, {0.0f, 1.0f, 0.0f}, view.fov});
    scene::validate(scene);
    scene.lights.clear();
    return scene;
}

// Rotation by `degrees` about an oblique axis, times `scale`, then moved.
inline scene::Transform oblique(float degrees, float scale, glm::vec3 moved) {
    const glm::vec3 a = glm::normalize(glm::vec3(1.0f, 2.0f, -0.5f));
    const float c = std::cos(glm::radians(degrees)), s = std::sin(glm::radians(degrees));
    scene::Transform t;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) {
            const float identity = row == column ? c : 0.0f;
            const int third = 3 - row - column;
            const float sign = (column - row + 3) % 3 == 1 ? -1.0f : 1.0f;
            const float skew = row == column ? 0.0f : sign * s * a[third];
            t.row[row][column] = scale * (identity + (1.0f - c) * a[row] * a[column] + skew);
        }
    for (int row = 0; row < 3; ++row)
        t.row[row].w = moved[row];
    return t;
}

inline glm::dvec3 at(const render::Image& image, std::uint32_t pixel) {
    const float* p = image.floats.data() + std::size_t{pixel} * image.components;
    return {p[0], image.components > 1 ? p[1] : 0.0f, image.components > 2 ? p[2] : 0.0f};
}

inline std::uint32_t pixels(const render::Image& image) {
    return image.width * image.height;
}

// Mean of value - expected and its standard error, over many independent pixels.
struct Deviation {
    double sum = 0.0, squares = 0.0;
    std::uint32_t count = 0;

    void add(double difference) {
        sum += difference;
        squares += difference * difference;
        ++count;
    }
    double mean() const { return sum / count; }
    double standard_error() const {
        return std::sqrt(std::max(squares / count - mean() * mean(), 0.0) / count);
    }
};

} // namespace macula::test
