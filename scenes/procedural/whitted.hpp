// The parts that the Whitted scene and the one that moves have in common.
#pragma once

#include "scenes/procedural/kit.hpp"

namespace macula::scene::procedural {

inline constexpr glm::ivec2 kSphereCells{192, 96};
inline constexpr glm::vec3 kGlassCentre{0.0f, 1.75f, 1.2f}, kMirrorCentre{1.35f, 1.0f, -1.5f};
inline constexpr float kGlassRadius = 1.05f, kMirrorRadius = 1.0f;

std::uint32_t add_glass(Scene& scene);
std::uint32_t add_mirror(Scene& scene);
// The checkerboard at y = 0.
void add_board(MeshBuilder& b, Scene& scene);
// The light, the sky and the classic camera.
void add_whitted_view(Scene& scene);
// Once round both spheres, looking at their middle at this height and dipping twice: the eye's
// distance from there (x) and its height (y) lie about `mean` by `dip`.
CameraPath round_tour(float height, glm::vec2 mean, glm::vec2 dip);

} // namespace macula::scene::procedural
