// Distances to an obstacle's surface, for contacts and for checks.
#pragma once

#include <span>

#include <glm/glm.hpp>

#include "scenes/physics/box_tree.hpp"

namespace macula::scene::physics {

struct Triangle {
    glm::vec3 a, b, c;
};

// Of the triangle the point nearest to `p` (Ericson, Real-Time Collision Detection, 5.1.5).
glm::vec3 nearest_point(const Triangle& triangle, const glm::vec3& p);
glm::vec3 nearest_point(const BoxNode& box, const glm::vec3& p);

// From `p` to the nearest of the triangles, whose tree this is; `most` where all are farther.
float distance(const BoxTree& tree, std::span<const Triangle> triangles, const glm::vec3& p,
               float most);

} // namespace macula::scene::physics
