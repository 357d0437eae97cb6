#include "scenes/occupancy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace macula::scene {
namespace {

constexpr int kMaxSplits = 18; // halvings of a triangle: 2^9 cells along an edge
// Beyond this many pieces (thousands of triangles as large as the scene) only corners are filled.
constexpr std::uint64_t kMaxPieces = 40'000'000;

} // namespace

Occupancy::Occupancy(const Scene& scene, int resolution) : bounds_(scene.bounds()) {
    const glm::vec3 extent = bounds_.hi - bounds_.lo;
    const float longest = std::max({extent.x, extent.y, extent.z});
    cell_ = longest > 0.0f ? longest / static_cast<float>(resolution) : 1.0f;
    for (int axis = 0; axis < 3; ++axis)
        size_[axis] = std::clamp(static_cast<int>(std::ceil(extent[axis] / cell_)), 1, resolution);
    cells_.resize(static_cast<std::size_t>(size_.x) * size_.y * size_.z);
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        const Transform& place = instance.world_from_object;
        for (const glm::uvec3& t : mesh.triangles)
            fill(place.apply(mesh.positions[t.x]), place.apply(mesh.positions[t.y]),
                 place.apply(mesh.positions[t.z]), 0);
    }
}

glm::ivec3 Occupancy::cell_of(const glm::vec3& point) const {
    const glm::vec3 at = glm::floor((point - bounds_.lo) / cell_);
    return glm::clamp(glm::ivec3(at), glm::ivec3(0), size_ - 1);
}

std::size_t Occupancy::index(const glm::ivec3& cell) const {
    return (static_cast<std::size_t>(cell.z) * size_.y + cell.y) * size_.x + cell.x;
}

// Halves the triangle along its longest edge until no piece is longer than a cell.
void Occupancy::fill(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, int depth) {
    const float ab = glm::distance(a, b), bc = glm::distance(b, c), ca = glm::distance(c, a);
    const bool small = std::max({ab, bc, ca}) <= 0.75f * cell_;
    if (small || depth >= kMaxSplits || pieces_ >= kMaxPieces) {
        ++pieces_;
        for (const glm::vec3& p : {a, b, c}) {
            Cell& cell = cells_[index(cell_of(p))];
            cell.filled = true;
            cell.normal += glm::cross(b - a, c - a);
        }
        return;
    }
    if (ab >= bc && ab >= ca) {
        const glm::vec3 m = 0.5f * (a + b);
        fill(a, m, c, depth + 1);
        fill(m, b, c, depth + 1);
    } else if (bc >= ca) {
        const glm::vec3 m = 0.5f * (b + c);
        fill(a, b, m, depth + 1);
        fill(a, m, c, depth + 1);
    } else {
        const glm::vec3 m = 0.5f * (c + a);
        fill(a, b, m, depth + 1);
        fill(m, b, c, depth + 1);
    }
}

bool Occupancy::solid(const glm::vec3& point) const {
    const bool inside = glm::all(glm::greaterThanEqual(point, bounds_.lo)) &&
                        glm::all(glm::lessThanEqual(point, bounds_.hi));
    return inside && cells_[index(cell_of(point))].filled;
}

// Amanatides and Woo 1987.
GridHit Occupancy::cast(const glm::vec3& origin, const glm::vec3& direction, float limit) const {
    constexpr float kFar = std::numeric_limits<float>::max();
    float enter = 0.0f, leave = limit;
    for (int axis = 0; axis < 3; ++axis) {
        if (std::fabs(direction[axis]) < 1e-8f) {
            if (origin[axis] < bounds_.lo[axis] || origin[axis] > bounds_.hi[axis])
                return {false, limit, 0.0f};
            continue;
        }
        const float t0 = (bounds_.lo[axis] - origin[axis]) / direction[axis];
        const float t1 = (bounds_.hi[axis] - origin[axis]) / direction[axis];
        enter = std::max(enter, std::min(t0, t1));
        leave = std::min(leave, std::max(t0, t1));
    }
    if (enter > leave)
        return {false, limit, 0.0f};
    glm::ivec3 cell = cell_of(origin + direction * enter);
    glm::vec3 next(kFar), step(kFar);
    for (int axis = 0; axis < 3; ++axis) {
        if (std::fabs(direction[axis]) < 1e-8f)
            continue;
        const int border = cell[axis] + (direction[axis] > 0.0f ? 1 : 0);
        next[axis] = (bounds_.lo[axis] + static_cast<float>(border) * cell_ - origin[axis]) /
                     direction[axis];
        step[axis] = cell_ / std::fabs(direction[axis]);
    }
    for (float t = enter; t <= leave;) {
        const Cell& here = cells_[index(cell)];
        if (here.filled) {
            const float length = glm::length(here.normal);
            const float facing = length > 0.0f ? -glm::dot(here.normal, direction) / length : 0.0f;
            return {true, t, facing};
        }
        const int axis = next.x <= next.y && next.x <= next.z ? 0 : next.y <= next.z ? 1 : 2;
        t = next[axis];
        next[axis] += step[axis];
        cell[axis] += direction[axis] > 0.0f ? 1 : -1;
        if (cell[axis] < 0 || cell[axis] >= size_[axis])
            break;
    }
    return {false, limit, 0.0f};
}

} // namespace macula::scene
