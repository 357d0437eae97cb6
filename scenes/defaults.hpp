// Views and lights for scenes that come without: what a plain OBJ file looks like at first sight.
#pragma once

#include "scenes/scene.hpp"

namespace macula::scene {

// Rectangle lights for emissive materials that cover one parallelogram each, such as the ceiling
// lamp of a Cornell box. At most kMaxEmissiveLights, the strongest first.
inline constexpr std::size_t kMaxEmissiveLights = 16;
std::vector<Light> lights_of_emissive_quads(const Scene& scene);

// Adds a camera and lights where there are none. The camera shows the scene from outside and above
// for objects and landscapes, from inside along a long and varied view for halls and rooms. The
// lights are those of emissive quads, or a key light above the camera's side, or, where the camera
// stands inside, one or two under the ceiling. `scene` has at least one triangle.
void add_default_view(Scene& scene);

} // namespace macula::scene
