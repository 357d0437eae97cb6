// The [physics] table of scene files: docs/scene-file.md.
#pragma once

#include "scenes/scene.hpp"
#include "scenes/toml_reader.hpp"

namespace macula::scene {

// Adds a ground, if the table asks for one, spheres, and their materials to `scene`; what it had
// before becomes obstacles. The scene must have instances that stand still. Throws SceneError as
// the table's getters do.
void read_physics(const TomlTable& table, Scene& scene);

} // namespace macula::scene
