// Scenes of the foveated benchmarks, with lights and fly-throughs.
#pragma once

#include <string>
#include <vector>

#include "scenes/scene.hpp"

namespace macula::bench {

// A built-in scene, a file, or the name of a scene file in the scene folders (bench/cases.hpp) or
// in scenes/files, such as `sibenik`: its geometry is looked for in the scene folders. Throws
// scene::SceneError, std::invalid_argument where a known scene's file is not found.
scene::Scene load_fly_through(const std::string& name, const std::vector<std::string>& scene_path);

// What rows call it: the name, or a file's without its extension.
std::string scene_name(const std::string& name);

// `name` where its geometry is found in the scene folders, else `otherwise`.
std::string scene_or(const std::string& name, const std::string& otherwise,
                     const std::vector<std::string>& scene_path);

} // namespace macula::bench
