// Polygons into triangles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace macula::scene {

// Polygons with more corners are split as fans, which is exact for convex ones only: ear clipping
// takes cubic time on hostile input.
inline constexpr std::size_t kMaxEarClipping = 256;

// Appends n - 2 triangles of indices into `corners` (n >= 3), keeping the winding. Quads are split
// along the shorter diagonal that does not fold them; larger polygons, which may be concave, by
// ear clipping in the plane of Newell's normal. Degenerate and non-finite corners give n - 2
// triangles all the same.
void triangulate(std::span<const glm::vec3> corners, std::vector<glm::uvec3>& triangles);

} // namespace macula::scene
