// A coarse picture of where a scene's surfaces lie and which way they face, for choosing views:
// cells of a grid over the bounds, filled by every triangle that may touch them.
#pragma once

#include <cstdint>
#include <vector>

#include "scenes/scene.hpp"

namespace macula::scene {

struct GridHit {
    bool hit = false;
    float distance = 0.0f; // to the cell's border, or the limit where nothing was hit
    // Cosine between the surface and the way back, by the sum of the cell's triangle normals:
    // positive for front faces, about 0 where both sides lie in one cell.
    float facing = 0.0f;
};

class Occupancy {
  public:
    // `resolution` cells along the longest side of the scene's bounds.
    Occupancy(const Scene& scene, int resolution);

    const Bounds& bounds() const { return bounds_; }
    float cell_size() const { return cell_; }
    bool solid(const glm::vec3& point) const;
    // The first filled cell along a ray of unit direction, from inside or outside the bounds.
    GridHit cast(const glm::vec3& origin, const glm::vec3& direction, float limit) const;

  private:
    struct Cell {
        glm::vec3 normal{0.0f}; // sum over triangles, area-weighted
        bool filled = false;
    };
    void fill(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, int depth);
    glm::ivec3 cell_of(const glm::vec3& point) const;
    std::size_t index(const glm::ivec3& cell) const;

    Bounds bounds_;
    float cell_ = 1.0f;
    glm::ivec3 size_{1};
    std::vector<Cell> cells_;
    std::uint64_t pieces_ = 0; // of triangles, so far
};

} // namespace macula::scene
