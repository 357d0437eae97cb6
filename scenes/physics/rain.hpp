// Spheres above a scene, ready to fall.
#pragma once

#include <cstdint>
#include <vector>

#include "scenes/scene.hpp"

namespace macula::scene::physics {

// Where the spheres start: in layers of a square grid, each sphere a little off its place.
struct Rain {
    std::uint32_t count = 50;
    glm::vec3 centre{0.0f};               // of the lowest layer, world units
    float spread = 1.0f;                  // half the square's side, at least 0
    std::vector<std::uint32_t> materials; // of the spheres in turn; never empty
};

// What `scene` has so far becomes the obstacles of `physics`; `rain` adds instances of spheres of
// physics.radius, one mesh for each material, and the scene moves by `physics` from now on.
void add_rain(Scene& scene, const Rain& rain, Physics physics);

} // namespace macula::scene::physics
