#include "scenes/load.hpp"

#include <algorithm>
#include <cctype>
#include <new>

#include "scenes/formats.hpp"
#include "scenes/procedural/registry.hpp"
#include "scenes/validate.hpp"

namespace macula::scene {
namespace {

std::string lower_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

std::string known_names() {
    std::string list;
    for (const std::string_view name : procedural::names())
        list += (list.empty() ? "" : ", ") + std::string(name);
    return list;
}

} // namespace

Scene load_file(const std::filesystem::path& path, const LoadOptions& options) {
    const std::string extension = lower_extension(without_compression(path));
    const bool known =
        extension == ".obj" || extension == ".gltf" || extension == ".glb" || extension == ".toml";
    std::error_code error;
    if (!known && std::filesystem::is_regular_file(path, error))
        throw SceneError(path.string() + ": unknown kind of file; known are .obj, .gltf, .glb and "
                                         ".toml, also followed by .gz or .zst");
    const std::string bytes = read_file(path, options.max_input_bytes);
    if (extension == ".obj")
        return load_obj(bytes, path, options);
    if (extension == ".toml")
        return load_scene_file(bytes, path, options);
    return load_gltf(bytes, path, extension == ".glb", options);
}

Scene load(const std::string& name_or_path, const LoadOptions& options) {
    Scene scene;
    try {
        procedural::SceneParams params;
        params.seed = options.seed;
        params.size = options.size;
        if (std::optional<Scene> built_in = procedural::make(name_or_path, params)) {
            scene = std::move(*built_in);
        } else {
            const std::filesystem::path path(name_or_path);
            std::error_code error;
            if (!path.has_extension() && !std::filesystem::exists(path, error))
                throw SceneError(
                    "'" + name_or_path +
                    "' is neither a file nor a built-in scene; built in are: " + known_names());
            scene = load_file(path, options);
        }
        validate(scene);
    } catch (const std::bad_alloc&) {
        throw SceneError(name_or_path + ": out of memory while loading the scene");
    }
    return scene;
}

} // namespace macula::scene
