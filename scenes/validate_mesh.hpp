// The part of validate() that looks at triangles.
#pragma once

#include "scenes/scene.hpp"

namespace macula::scene {

void validate_meshes(Scene& scene);

} // namespace macula::scene
