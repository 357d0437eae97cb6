// What a scene is made of, as a number.
#pragma once

#include <string>

#include "scenes/scene.hpp"

namespace macula::bench {

// 32 hexadecimal digits: XXH3 (128 bits) of everything that pixels depend on, which cameras, paths,
// names and preferences are not.
std::string scene_hash(const scene::Scene& scene);

} // namespace macula::bench
