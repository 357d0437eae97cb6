// The simulation's own space: Bullet's tolerances are made for bodies of about one unit, so that
// every sphere has the same radius there, whatever it measures in the scene.
#pragma once

#include <glm/glm.hpp>

namespace macula::scene::physics {

inline constexpr float kSimulatedRadius = 0.5f;

struct Units {
    glm::vec3 origin{0.0f}; // world space, of the simulation's space
    float scale = 1.0f;     // simulation units of a world unit

    glm::vec3 from_world(const glm::vec3& p) const { return (p - origin) * scale; }
    glm::vec3 to_world(const glm::vec3& p) const { return p / scale + origin; }
};

} // namespace macula::scene::physics
