// What a scene file changes in the scene that it names.
#pragma once

#include "scenes/scene.hpp"
#include "scenes/toml_reader.hpp"

namespace macula::scene {

enum class UpAxis : std::uint8_t { x, y, z };

// Turns the scene so that `up` of the file becomes +y, and scales it: geometry, lights, cameras and
// path of the named file. Throws SceneError when coordinates overflow.
void transform_scene(Scene& scene, UpAxis up, float scale);

// Applies one [[material]] table to the materials of that name; no such material is an error.
void override_material(const TomlTable& table, Scene& scene);

} // namespace macula::scene
