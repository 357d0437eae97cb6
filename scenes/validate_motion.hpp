// The part of validate() that looks at what moves.
#pragma once

#include "scenes/scene.hpp"

namespace macula::scene {

// Throws SceneError on key frames and physics that make no sense; brings rotations to unit length
// and the instances that key frames move to where frame 0 has them. Instances and meshes must be
// in order already.
void validate_motion(Scene& scene);

// Instance i has become renumbered[i], or was dropped where that is kNoTexture.
void renumber_moving(Scene& scene, const std::vector<std::uint32_t>& renumbered);

} // namespace macula::scene
