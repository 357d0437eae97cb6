// Fly-throughs of 1000 frames, the length of the benchmark's paths (Weier et al. 2016, section 4).
#pragma once

#include <span>

#include "scenes/scene.hpp"

namespace macula::scene::procedural {

struct Waypoint {
    glm::vec3 eye, target;
};

inline constexpr std::uint32_t kPathFrames = 1000;

// A path through all waypoints at nearly constant speed (of eye and gaze together), with a key
// frame every 20 frames. `closed`: the last frame leads back to the first one.
CameraPath fly_through(std::span<const Waypoint> waypoints, bool closed);

} // namespace macula::scene::procedural
