#include "scenes/procedural/kit.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "scenes/procedural/random.hpp"

namespace macula::scene::procedural {
namespace {

// Texture coordinates of a point on a face: its world position along the two lesser axes.
glm::vec2 planar(glm::vec3 p, glm::vec3 normal, float tile) {
    const glm::vec3 n = glm::abs(normal);
    if (n.y >= n.x && n.y >= n.z)
        return glm::vec2{p.x, normal.y >= 0.0f ? -p.z : p.z} / tile;
    if (n.x >= n.z)
        return glm::vec2{normal.x >= 0.0f ? -p.z : p.z, p.y} / tile;
    return glm::vec2{normal.z >= 0.0f ? p.x : -p.x, p.y} / tile;
}

glm::vec3 polygon_normal(std::span<const glm::vec3> corners) {
    glm::vec3 sum{0.0f};
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        sum += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    const float length = glm::length(sum);
    return length > 0.0f ? sum / length : glm::vec3{0.0f, 1.0f, 0.0f};
}

} // namespace

Placement upright(glm::vec3 origin, float turns, float scale) {
    const glm::vec2 cs = sin_cos_turns(turns);
    return {origin, {cs.x, 0.0f, -cs.y}, {0.0f, 1.0f, 0.0f}, {cs.y, 0.0f, cs.x}, scale};
}

Placement along(glm::vec3 origin, glm::vec3 axis) {
    const glm::vec3 helper = std::fabs(axis.y) < 0.9f ? glm::vec3{0, 1, 0} : glm::vec3{1, 0, 0};
    const glm::vec3 x = glm::normalize(glm::cross(helper, axis));
    return {origin, x, axis, glm::cross(x, axis), 1.0f};
}

MeshBuilder::MeshBuilder(std::string name) {
    mesh_.name = std::move(name);
}

std::uint32_t MeshBuilder::vertex(glm::vec3 p, glm::vec3 n, glm::vec2 uv) {
    mesh_.positions.push_back(place.point(p));
    mesh_.normals.push_back(glm::normalize(place.vector(n)));
    mesh_.uvs.push_back(uv);
    return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
}

void MeshBuilder::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                           std::uint32_t material) {
    const auto& p = mesh_.positions;
    const glm::vec3 ab = p[b] - p[a], ac = p[c] - p[a], bc = p[c] - p[b];
    const glm::vec3 cross = glm::cross(ab, ac);
    const float longest = std::max(glm::dot(ab, ab), std::max(glm::dot(ac, ac), glm::dot(bc, bc)));
    if (!(glm::dot(cross, cross) > 1e-10f * longest * longest))
        return;
    if (place.mirrored())
        std::swap(b, c);
    mesh_.triangles.push_back({a, b, c});
    mesh_.triangle_material.push_back(material);
}

void MeshBuilder::quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d,
                       std::uint32_t material) {
    triangle(a, b, c, material);
    triangle(a, c, d, material);
}

void MeshBuilder::face(std::span<const glm::vec3> corners, Finish finish) {
    const glm::vec3 normal = polygon_normal(corners);
    const glm::vec3 world_normal = place.vector(normal);
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    for (const glm::vec3& p : corners)
        vertex(p, normal, planar(place.point(p), world_normal, finish.tile));
    for (std::uint32_t i = 1; i + 1 < corners.size(); ++i)
        triangle(first, first + i, first + i + 1, finish.material);
}

void MeshBuilder::face(std::initializer_list<glm::vec3> corners, Finish finish) {
    face(std::span<const glm::vec3>(corners.begin(), corners.size()), finish);
}

void MeshBuilder::card(std::span<const glm::vec3> corners, std::span<const glm::vec2> uvs,
                       std::uint32_t material) {
    const glm::vec3 normal = polygon_normal(corners);
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    for (std::size_t i = 0; i < corners.size(); ++i)
        vertex(corners[i], normal, uvs[i]);
    for (std::uint32_t i = 1; i + 1 < corners.size(); ++i)
        triangle(first, first + i, first + i + 1, material);
}

Mesh MeshBuilder::take() {
    return std::move(mesh_);
}

void box(MeshBuilder& b, glm::vec3 lo, glm::vec3 hi, Finish finish, unsigned skip) {
    const auto at = [&](int x, int y, int z) {
        return glm::vec3{x != 0 ? hi.x : lo.x, y != 0 ? hi.y : lo.y, z != 0 ? hi.z : lo.z};
    };
    if ((skip & kLeft) == 0)
        b.face({at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0)}, finish);
    if ((skip & kRight) == 0)
        b.face({at(1, 0, 1), at(1, 0, 0), at(1, 1, 0), at(1, 1, 1)}, finish);
    if ((skip & kBottom) == 0)
        b.face({at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)}, finish);
    if ((skip & kTop) == 0)
        b.face({at(0, 1, 1), at(1, 1, 1), at(1, 1, 0), at(0, 1, 0)}, finish);
    if ((skip & kBack) == 0)
        b.face({at(1, 0, 0), at(0, 0, 0), at(0, 1, 0), at(1, 1, 0)}, finish);
    if ((skip & kFront) == 0)
        b.face({at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)}, finish);
}

void block(MeshBuilder& b, glm::vec3 lo, glm::vec3 hi, float bevel, Finish finish) {
    const glm::vec3 centre = 0.5f * (lo + hi), half = 0.5f * (hi - lo);
    // The corner of octant `signs` on the face across `axis`: inset along the two other axes.
    const auto corner = [&](glm::vec3 signs, int axis) {
        glm::vec3 inset = half - bevel;
        inset[axis] = half[axis];
        return centre + signs * inset;
    };
    const auto outward = [&](std::array<glm::vec3, 4> c, glm::vec3 n) {
        if (glm::dot(glm::cross(c[1] - c[0], c[2] - c[0]), n) < 0.0f)
            std::swap(c[1], c[3]);
        b.face(c, finish);
    };
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 n{0.0f}, s{0.0f};
            n[axis] = s[axis] = side;
            std::array<glm::vec3, 4> c;
            static constexpr std::array<std::array<float, 2>, 4> kTurn{
                {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
            for (std::size_t k = 0; k < 4; ++k) {
                s[u] = kTurn[k][0];
                s[v] = kTurn[k][1];
                c[k] = corner(s, axis);
            }
            outward(c, n);
            // The chamfer towards +-u, so that each of the twelve edges is made once.
            for (const float edge : {-1.0f, 1.0f}) {
                glm::vec3 low = s, high = s, slope{0.0f};
                low[u] = high[u] = edge;
                low[v] = -1.0f;
                high[v] = 1.0f;
                slope[axis] = side;
                slope[u] = edge;
                outward({corner(low, axis), corner(high, axis), corner(high, u), corner(low, u)},
                        slope);
            }
        }
    }
    for (int octant = 0; octant < 8; ++octant) {
        const glm::vec3 s{(octant & 1) != 0 ? 1.0f : -1.0f, (octant & 2) != 0 ? 1.0f : -1.0f,
                          (octant & 4) != 0 ? 1.0f : -1.0f};
        std::array<glm::vec3, 3> c{corner(s, 0), corner(s, 1), corner(s, 2)};
        if (s.x * s.y * s.z < 0.0f)
            std::swap(c[1], c[2]);
        b.face(c, finish);
    }
}

} // namespace macula::scene::procedural
