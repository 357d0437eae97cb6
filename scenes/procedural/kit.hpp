// A small kit for building meshes from parts: flat faces, boxes, parametric surfaces, surfaces of
// revolution, sweeps. Lengths in the scene's units; front faces are counter-clockwise seen from
// outside; degenerate triangles are dropped as they come.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "scenes/scene.hpp"

namespace macula::scene::procedural {

// A local frame in the mesh: orthonormal axes (a mirrored frame is allowed) and a uniform scale.
struct Placement {
    glm::vec3 origin{0.0f};
    glm::vec3 x{1.0f, 0.0f, 0.0f}, y{0.0f, 1.0f, 0.0f}, z{0.0f, 0.0f, 1.0f};
    float scale = 1.0f;

    glm::vec3 point(glm::vec3 p) const { return origin + scale * (x * p.x + y * p.y + z * p.z); }
    glm::vec3 vector(glm::vec3 v) const { return x * v.x + y * v.y + z * v.z; }
    bool mirrored() const { return glm::dot(glm::cross(x, y), z) < 0.0f; }
};

// At `origin`, turned about +y by `turns` full turns (+z towards +x).
Placement upright(glm::vec3 origin, float turns = 0.0f, float scale = 1.0f);
// +y along `axis` (unit length), the others arbitrary but fixed by it.
Placement along(glm::vec3 origin, glm::vec3 axis);

// What a face is made of: a material and how many scene units one repeat of its texture spans.
struct Finish {
    std::uint32_t material = 0;
    float tile = 1.0f;
};

class MeshBuilder {
  public:
    explicit MeshBuilder(std::string name);

    // Where the parts that follow go. Parts are given in its local frame.
    Placement place;

    // Adds a vertex with a unit local normal; returns its index.
    std::uint32_t vertex(glm::vec3 p, glm::vec3 n, glm::vec2 uv);
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t material);
    void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d,
              std::uint32_t material);

    // A convex flat polygon, counter-clockwise; texture projected along the dominant world axis,
    // so that it runs on from face to face.
    void face(std::span<const glm::vec3> corners, Finish finish);
    void face(std::initializer_list<glm::vec3> corners, Finish finish);
    // The same with explicit texture coordinates.
    void card(std::span<const glm::vec3> corners, std::span<const glm::vec2> uvs,
              std::uint32_t material);

    const Mesh& mesh() const { return mesh_; }
    std::size_t triangle_count() const { return mesh_.triangles.size(); }
    Mesh take();

  private:
    Mesh mesh_;
};

// Faces of a box to leave out.
enum BoxSide : unsigned { kLeft = 1, kRight = 2, kBottom = 4, kTop = 8, kBack = 16, kFront = 32 };
// -x left, +x right, -y bottom, +y top, -z back, +z front.
void box(MeshBuilder& b, glm::vec3 lo, glm::vec3 hi, Finish finish, unsigned skip = 0);
// A box with chamfered edges.
void block(MeshBuilder& b, glm::vec3 lo, glm::vec3 hi, float bevel, Finish finish);

// A grid of columns x rows points with smooth normals along cross(du, dv); row-major. A closed
// grid repeats its first column (row) as its last one: normals then run on across the seam.
struct GridShape {
    int columns = 2, rows = 2;
    bool closed_columns = false, closed_rows = false;
};
void surface(MeshBuilder& b, GridShape shape, std::span<const glm::vec3> points,
             std::span<const glm::vec2> uvs, std::uint32_t material);
// The same from functions of (s, t) in [0, 1]^2; `cells` are columns x rows of quads.
void surface(MeshBuilder& b, glm::ivec2 cells, const std::function<glm::vec3(float, float)>& point,
             const std::function<glm::vec2(float, float)>& uv, std::uint32_t material);

// Rotates a profile of (radius, height) about +y. The profile runs with the outside on its right
// (upwards for a column). Its corners sharper than 35 degrees are kept sharp.
struct Revolution {
    int segments = 24;
    float from_turn = 0.0f, to_turn = 1.0f;
    // Multiplies the radius at (turn, height); empty: a circle.
    std::function<float(float, float)> modulation;
};
void revolve(MeshBuilder& b, std::span<const glm::vec2> profile, const Revolution& how,
             Finish finish);

// One station of a sweep: section point (s, t) lies at position + s * right + t * up.
struct Station {
    glm::vec3 position, right, up;
};
// Sweeps an open polyline section along stations; the outside is on the section's right when
// looking along the sweep. Sharp corners of the section (over 35 degrees) are kept.
void sweep(MeshBuilder& b, std::span<const glm::vec2> section, std::span<const Station> stations,
           Finish finish);
// A tube of `sides` around a polyline.
void tube(MeshBuilder& b, std::span<const glm::vec3> line, float radius, int sides, Finish finish);

void sphere(MeshBuilder& b, glm::vec3 centre, float radius, glm::ivec2 cells, Finish finish);

} // namespace macula::scene::procedural
