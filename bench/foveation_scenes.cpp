#include "bench/foveation_scenes.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <stdexcept>

#include <fmt/format.h>

#include "bench/cases.hpp"
#include "scenes/load.hpp"

namespace macula::bench {
namespace {

namespace fs = std::filesystem;

// Scenes that lie in files: how they are called below a scene folder.
struct FileScene {
    const char* name;
    const char* geometry;
};
constexpr std::array kFileScenes = {FileScene{"bunny_5k", "bunny/bunny_5k.obj"},
                                    FileScene{"bunny_5k_spheres", "bunny/bunny_5k.obj"},
                                    FileScene{"bunny_spheres", "bunny/bunny_69k.obj"},
                                    FileScene{"sibenik", "sibenik/sibenik.obj"},
                                    FileScene{"sponza_crytek", "sponza_crytek/sponza.obj"}};

bool is_found(const char* file, std::span<const fs::path> folders) {
    return std::any_of(folders.begin(), folders.end(), [&](const fs::path& folder) {
        std::error_code ignored;
        return fs::is_regular_file(folder / file, ignored);
    });
}

// The scene file NAME.toml, which adds lights, views or a fly-through; names that have none stay.
std::string scene_file(const std::string& name, std::span<const fs::path> folders) {
    if (fs::path(name).has_extension() || fs::path(name).has_parent_path())
        return name;
    const bool is_known = std::any_of(kFileScenes.begin(), kFileScenes.end(),
                                      [&](const FileScene& s) { return name == s.name; });
    std::vector<fs::path> places(folders.begin(), folders.end());
    places.insert(places.end(), {"scenes/files", MACULA_SCENE_FILES});
    for (const fs::path& place : places) {
        std::error_code ignored;
        if (fs::is_regular_file(place / (name + ".toml"), ignored))
            return (place / (name + ".toml")).string();
    }
    if (!is_known)
        return name;
    throw std::invalid_argument(fmt::format(
        "--scene {}: {}.toml lies in none of the scene folders nor in scenes/files", name, name));
}

} // namespace

std::string scene_name(const std::string& name) {
    return fs::path(name).filename().replace_extension().string();
}

scene::Scene load_fly_through(const std::string& name, const std::vector<std::string>& scene_path) {
    scene::LoadOptions options;
    options.search_path = scene_folders(scene_path);
    return scene::load(scene_file(name, options.search_path), options);
}

std::string scene_or(const std::string& name, const std::string& otherwise,
                     const std::vector<std::string>& scene_path) {
    const auto folders = scene_folders(scene_path);
    for (const FileScene& scene : kFileScenes) {
        if (name == scene.name && is_found(scene.geometry, folders))
            return name;
    }
    return otherwise;
}

} // namespace macula::bench
