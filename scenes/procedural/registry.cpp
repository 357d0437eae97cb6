#include "scenes/procedural/registry.hpp"

#include <array>

#include "scenes/procedural/builtin.hpp"

namespace macula::scene::procedural {
namespace {

struct Entry {
    std::string_view name;
    Scene (*make)(const SceneParams&);
};

constexpr std::array kScenes{
    Entry{"atrium", make_atrium},
    Entry{"voxel_city", make_voxel_city},
    Entry{"city", make_city},
    Entry{"cornell", make_cornell},
    Entry{"cornell_spheres", make_cornell_spheres},
    Entry{"whitted", make_whitted},
    Entry{"whitted_moving", make_whitted_moving},
    Entry{"tunnel_geometry", make_tunnel_geometry},
    Entry{"tunnel_maps", make_tunnel_maps},
    Entry{"spheres", make_spheres},
};

// Meshes made here are placed once, where they were built, unless the maker placed them itself.
void place_meshes(Scene& scene) {
    if (!scene.instances.empty())
        return;
    for (std::uint32_t i = 0; i < scene.meshes.size(); ++i)
        scene.instances.push_back({i, Transform{}, scene.meshes[i].name});
}

} // namespace

std::optional<Scene> make(std::string_view name, const SceneParams& params) {
    for (const Entry& entry : kScenes) {
        if (entry.name != name)
            continue;
        Scene scene = entry.make(params);
        scene.name = name;
        place_meshes(scene);
        place_instances(scene, 0.0f);
        return scene;
    }
    return std::nullopt;
}

std::vector<std::string_view> names() {
    std::vector<std::string_view> all;
    all.reserve(kScenes.size());
    for (const Entry& entry : kScenes)
        all.push_back(entry.name);
    return all;
}

} // namespace macula::scene::procedural
