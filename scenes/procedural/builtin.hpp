// The makers behind the registry, one for each scene.
#pragma once

#include "scenes/procedural/registry.hpp"

namespace macula::scene::procedural {

Scene make_cornell(const SceneParams& params);
Scene make_cornell_spheres(const SceneParams& params);
Scene make_whitted(const SceneParams& params);
Scene make_whitted_moving(const SceneParams& params);
Scene make_tunnel_geometry(const SceneParams& params);
Scene make_atrium(const SceneParams& params);
Scene make_voxel_city(const SceneParams& params);
Scene make_city(const SceneParams& params);
Scene make_spheres(const SceneParams& params);
Scene make_tunnel_maps(const SceneParams& params);

} // namespace macula::scene::procedural
