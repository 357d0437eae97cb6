// The head in the world: a camera whose eye is the point between the wearer's eyes.
#pragma once

#include <glm/glm.hpp>

#include "scenes/display.hpp"
#include "scenes/scene.hpp"

namespace macula::scene {

// Head space's x (right), y (up) and z (back) in the world, as columns: a rotation. Where `up` lies
// along the view, another axis takes its place, as in frame::make_camera.
glm::dmat3 world_from_head(const Camera& head);

// The view of an eye in head space from a head in the world, `units_per_metre` being the world's.
// An eye in the head's middle that looks straight ahead is the head's camera, bit for bit.
Camera eye_camera(const Camera& head, const EyeView& eye, double units_per_metre);

} // namespace macula::scene
