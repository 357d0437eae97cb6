// The file formats behind load(). Each returns what the file says, not yet validated.
#pragma once

#include <filesystem>
#include <string>

#include "scenes/load.hpp"

namespace macula::scene {

// What rays that miss see in files of formats that do not say: a dim sky.
inline constexpr glm::vec3 kDefaultSky{0.2f, 0.25f, 0.32f};

// `text` is the unpacked file; `path` names it in messages, and its folder holds what it refers to.
Scene load_obj(const std::string& text, const std::filesystem::path& path,
               const LoadOptions& options);
Scene load_gltf(const std::string& bytes, const std::filesystem::path& path, bool binary,
                const LoadOptions& options);

// Any of them, by extension; scene files use it for what they name.
Scene load_file(const std::filesystem::path& path, const LoadOptions& options);

// Reads the scene file and what it names.
Scene load_scene_file(const std::string& text, const std::filesystem::path& path,
                      const LoadOptions& options);

} // namespace macula::scene
