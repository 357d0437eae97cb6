// Key frames of one node of a scene file's [motion].
#pragma once

#include "scenes/motion.hpp"
#include "scenes/toml_reader.hpp"

namespace macula::scene {

// Reads the node's pose at rest, its interpolation and its keys. Smooth keys that close a round of
// `period` frames pass its end without a kink.
void read_keys(const TomlTable& table, float period, MotionNode& node);

} // namespace macula::scene
