// Views and lights for scenes that come without: what a plain OBJ file looks like at first sight.
#pragma once

#include "scenes/scene.hpp"

namespace macula::scene {

// Rectangle lights for emissive materials that cover one parallelogram each, such as the ceiling
// lamp of a Cornell box. At most kMaxEmissiveLights, the strongest first.
inline constexpr std::size_t kMaxEmissiveLights = 16;
std::vector<Light> lights_of_emissive_quads(const Scene& scene);

// A camera that shows the scene: from outside and above for objects, from inside along the longest
// free view for halls, rooms and landscapes. `scene` has at least one triangle.
Camera default_camera(const Scene& scene);

// A key light above the side of `camera`, or, where the camera stands inside, under the ceiling of
// the free space around it.
std::vector<Light> default_lights(const Scene& scene, const Camera& camera);

} // namespace macula::scene
