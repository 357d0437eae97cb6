// [motion] of scene files: what docs/scene-file.md says of key frames.
#pragma once

#include "scenes/load.hpp"
#include "scenes/toml_reader.hpp"

namespace macula::scene {

// What [motion] asks of the loader of the named file.
void read_motion_options(const TomlTable& root, LoadOptions& options);

// Adds the nodes of [motion] to the scene, whose instances they name.
void read_motion(const TomlTable& root, Scene& scene);

} // namespace macula::scene
