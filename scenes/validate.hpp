// What every scene passes before the engine sees it: errors where it makes no sense, counted
// warnings where it can be mended, defaults where something is missing.
#pragma once

#include "scenes/error.hpp"
#include "scenes/scene.hpp"

namespace macula::scene {

// Coordinates at or beyond this size count as not finite (bvh::Geometry's limit), in object and in
// world space.
inline constexpr float kMaxCoordinate = 1e18f;
inline constexpr float kMaxTexcoord = 1e6f;
// Triangles of one scene, over meshes: what a leaf reference of shared/bvh.h can address.
inline constexpr std::uint64_t kMaxTriangles = std::uint64_t{1} << 27;

// Throws SceneError, naming mesh and triangle, on indices out of range, arrays of unequal length,
// singular transforms, too many triangles, a scene without any triangle, and key frames or physics
// that make no sense. Instances that key frames move are placed where frame 0 has them. Mends, with
// counted warnings: triangles with coordinates that are not finite (dropped), normals of zero
// length (replaced by geometric ones) or of other than unit length (normalised), texture
// coordinates that are not finite (0), parameters out of range (clamped), empty meshes (dropped,
// with their instances). Degenerate triangles are counted and kept. Adds a material, a light and a
// camera where there are none (defaults.hpp).
void validate(Scene& scene);

} // namespace macula::scene
