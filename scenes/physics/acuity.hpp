// How coarsely a sphere may meet the obstacles, by where the eye looks.
#pragma once

#include "scenes/motion.hpp"
#include "scenes/mover.hpp"

namespace macula::scene::physics {

// Angle in degrees, 0..180, between the gaze and the sphere's nearest edge; 0 where the gaze meets
// the sphere or the eye is inside of it.
float eccentricity(const Observer& observer, const glm::vec3& centre, float radius);

// Levels, counted from the deepest leaf upwards, that a sphere at this eccentricity leaves out:
// 0 within acuity.exact_degrees, then 1 and one more every 1 / levels_per_degree degrees.
int levels_left_out(const CollisionAcuity& acuity, float eccentricity_degrees);

} // namespace macula::scene::physics
