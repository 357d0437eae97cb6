/// The small scene and the rays of the traversal self-test: a rough height field and leaf cards
/// with an alpha mask, each placed several times with rotations and scales, and rays that meet
/// them in order and in none.
#pragma once

#include "bvh/reference.hpp"
#include "scenes/scene.hpp"

#include <vector>

namespace macula::selftest {

scene::Scene make_scene();

/// A 40 x 40 camera grid in 4 x 4 packets, from above at an angle.
std::vector<bvh::Ray> coherent_rays();

/// Rays between random points around the scene, among them axis-parallel ones and inactive ones.
std::vector<bvh::Ray> incoherent_rays();

} // namespace macula::selftest
