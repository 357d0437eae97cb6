// The built-in scenes, by name. Each is deterministic: the same name and parameters give the same
// bytes on every platform (own counter-based hash, own elementary functions).
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "scenes/scene.hpp"

namespace macula::scene::procedural {

struct SceneParams {
    std::uint64_t seed = 1;
    // voxel_city: side length in blocks, 32..2048. Other scenes have one size and ignore it.
    // 0: the default size.
    std::uint32_t size = 0;
};

// The scene called `name`, or nothing when there is no such scene. Throws std::invalid_argument
// when a parameter is out of range.
std::optional<Scene> make(std::string_view name, const SceneParams& params = {});

// All names that make() knows, in the order in which they should be listed.
std::vector<std::string_view> names();

} // namespace macula::scene::procedural
