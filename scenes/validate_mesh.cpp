#include "scenes/validate_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/validate.hpp"

namespace macula::scene {
namespace {

struct Findings {
    std::uint64_t dropped = 0, degenerate = 0, replaced_normals = 0, scaled_normals = 0,
                  bad_uvs = 0;
};

bool finite(const glm::vec3& p) {
    return std::fabs(p.x) < kMaxCoordinate && std::fabs(p.y) < kMaxCoordinate &&
           std::fabs(p.z) < kMaxCoordinate; // false for NaN
}

void check_sizes(const Mesh& mesh, const std::string& where) {
    const std::size_t count = mesh.positions.size();
    if (count > 0xfffffffeu)
        throw SceneError(where + ": too many vertices");
    if (!mesh.normals.empty() && mesh.normals.size() != count)
        throw SceneError(where + ": " + std::to_string(mesh.normals.size()) + " normals for " +
                         std::to_string(count) + " vertices");
    if (!mesh.uvs.empty() && mesh.uvs.size() != count)
        throw SceneError(where + ": " + std::to_string(mesh.uvs.size()) +
                         " texture coordinates for " + std::to_string(count) + " vertices");
    if (mesh.triangle_material.size() != mesh.triangles.size())
        throw SceneError(where + ": " + std::to_string(mesh.triangle_material.size()) +
                         " material indices for " + std::to_string(mesh.triangles.size()) +
                         " triangles");
}

void check_indices(const Mesh& mesh, std::size_t materials, const std::string& where) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (int corner = 0; corner < 3; ++corner)
            if (mesh.triangles[t][corner] >= mesh.positions.size())
                throw SceneError(where + ", triangle " + std::to_string(t) + ", corner " +
                                 std::to_string(corner) + ": vertex index " +
                                 std::to_string(mesh.triangles[t][corner]) + " is out of range: " +
                                 std::to_string(mesh.positions.size()) + " vertices");
        if (mesh.triangle_material[t] >= materials)
            throw SceneError(where + ", triangle " + std::to_string(t) + ": material index " +
                             std::to_string(mesh.triangle_material[t]) +
                             " is out of range: " + std::to_string(materials) + " materials");
    }
}

// Unused vertices may be anything: they are set to the origin, so that no later loop over vertices
// meets what is not finite.
void drop_unusable(Mesh& mesh, Findings& found) {
    std::vector<bool> bad(mesh.positions.size());
    bool any = false;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        if (!finite(mesh.positions[v])) {
            bad[v] = any = true;
            mesh.positions[v] = glm::vec3(0.0f);
        }
    std::size_t kept = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::uvec3 triangle = mesh.triangles[t];
        if (any && (bad[triangle.x] || bad[triangle.y] || bad[triangle.z])) {
            ++found.dropped;
            continue;
        }
        mesh.triangles[kept] = triangle;
        mesh.triangle_material[kept++] = mesh.triangle_material[t];
        const glm::dvec3 a(mesh.positions[triangle.x]), b(mesh.positions[triangle.y]),
            c(mesh.positions[triangle.z]);
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        found.degenerate += glm::dot(normal, normal) == 0.0;
    }
    mesh.triangles.resize(kept);
    mesh.triangle_material.resize(kept);
}

// The area-weighted mean of the adjoining triangles' normals, for the vertices marked in `wanted`.
void replace_normals(Mesh& mesh, const std::vector<bool>& wanted) {
    std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
    for (const glm::uvec3& triangle : mesh.triangles) {
        if (!wanted[triangle.x] && !wanted[triangle.y] && !wanted[triangle.z])
            continue;
        const glm::dvec3 a(mesh.positions[triangle.x]), b(mesh.positions[triangle.y]),
            c(mesh.positions[triangle.z]);
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        for (int corner = 0; corner < 3; ++corner)
            sums[triangle[corner]] += normal;
    }
    for (std::size_t v = 0; v < sums.size(); ++v) {
        if (!wanted[v])
            continue;
        const double length = glm::length(sums[v]);
        mesh.normals[v] = length > 0.0 ? glm::vec3(sums[v] / length) : glm::vec3(0.0f, 1.0f, 0.0f);
    }
}

void mend_normals(Mesh& mesh, Findings& found) {
    if (mesh.normals.empty())
        return;
    std::vector<bool> zero(mesh.normals.size());
    for (std::size_t v = 0; v < mesh.normals.size(); ++v) {
        const glm::dvec3 normal(mesh.normals[v]);
        const double length = glm::length(normal);
        if (!(length > 1e-20) || !std::isfinite(length)) {
            zero[v] = true;
        } else {
            found.scaled_normals += std::fabs(length - 1.0) > 0.01;
            mesh.normals[v] = glm::vec3(normal / length);
        }
    }
    std::vector<bool> used(mesh.normals.size());
    for (const glm::uvec3& triangle : mesh.triangles)
        for (int corner = 0; corner < 3; ++corner)
            used[triangle[corner]] = true;
    std::uint64_t replaced = 0;
    for (std::size_t v = 0; v < zero.size(); ++v)
        replaced += zero[v] && used[v];
    found.replaced_normals += replaced;
    if (std::find(zero.begin(), zero.end(), true) != zero.end())
        replace_normals(mesh, zero);
}

void mend_uvs(Mesh& mesh, Findings& found) {
    for (glm::vec2& uv : mesh.uvs)
        if (!(std::fabs(uv.x) < kMaxTexcoord && std::fabs(uv.y) < kMaxTexcoord)) {
            uv = glm::vec2(0.0f);
            ++found.bad_uvs;
        }
}

void report(std::uint64_t count, const char* what, Scene& scene) {
    if (count > 0)
        scene.warnings.push_back(std::to_string(count) + " " + what);
}

} // namespace

void validate_meshes(Scene& scene) {
    Findings found;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        Mesh& mesh = scene.meshes[m];
        const std::string where =
            scene.name + ": mesh " + std::to_string(m) + " '" + mesh.name + "'";
        check_sizes(mesh, where);
        check_indices(mesh, scene.materials.size(), where);
        drop_unusable(mesh, found);
        mend_normals(mesh, found);
        mend_uvs(mesh, found);
    }
    report(found.dropped,
           "triangles with coordinates that are not finite, or beyond 1e18, are left out", scene);
    report(found.degenerate, "triangles have no area", scene);
    report(found.replaced_normals, "normals of no length are replaced by geometric ones", scene);
    report(found.scaled_normals, "normals were not of unit length", scene);
    report(found.bad_uvs, "texture coordinates that are not finite, or beyond 1e6, are set to 0",
           scene);
}

} // namespace macula::scene
