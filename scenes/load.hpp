// The one door to scenes: a built-in name or a file becomes a valid Scene.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scenes/error.hpp"
#include "scenes/input.hpp"
#include "scenes/scene.hpp"

namespace macula::scene {

struct LoadOptions {
    std::uint64_t seed = 1; // procedural scenes
    std::uint32_t size = 0; // procedural scenes that have one; 0: their default
    // Where scene files look for the files they name, after their own folder. The folders of the
    // environment variable MACULA_SCENE_PATH (separated by ':') follow these.
    std::vector<std::filesystem::path> search_path;
    std::uint64_t max_input_bytes = kDefaultMaxInputBytes; // for each file, unpacked
    int nesting = 0; // how many scene files led here; set by the loader
    // glTF: nodes of these names, with what is below them, become instances of these names.
    std::vector<std::string> kept_nodes;
    // glTF: an animation's name or its index; empty: the first, "none": none.
    std::string animation;
    float frame_rate = 60.0f; // glTF: frames a second of its animations, 1..1000
    bool textures = true; // false: every texture becomes the 1 x 1 white one (fast, for geometry)
};

// Loads a built-in scene by name, or a file by its extension: .obj, .gltf, .glb, .toml, each also
// with .gz or .zst after it. The result has passed validate() and has at least one triangle,
// material, light and camera. Throws SceneError naming file, place and cause.
Scene load(const std::string& name_or_path, const LoadOptions& options = {});

} // namespace macula::scene
