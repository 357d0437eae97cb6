// Evaluation of fly-throughs.
#pragma once

#include "scenes/scene.hpp"

namespace macula::scene {

struct CameraView {
    glm::vec3 eye, target;
};

// The path's view at `frame`, clamped to its first and last key: the Catmull-Rom spline through
// the keys, whose tangents take account of uneven distances in time. Throws std::invalid_argument
// when the path has no keys.
CameraView view_at(const CameraPath& path, float frame);

} // namespace macula::scene
