#include "bench/cases.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string_view>

#include "scenes/load.hpp"

namespace macula::bench {
namespace {

namespace fs = std::filesystem;

// Fixed views of scenes that are not ours, so that figures stay comparable.
struct KnownScene {
    std::string_view name;
    const char* file; // below a scene folder
    glm::vec3 eye, target;
    float vertical_fov_degrees;
    glm::vec3 light;
};
const std::array<KnownScene, 2> kKnownScenes{{
    {"sponza_crytek",
     "sponza_crytek/sponza.obj",
     {-1100, 250, -30},
     {500, 300, 0},
     75.0f,
     {100, 1350, 20}},
    {"minecraft_overworld",
     "minecraft_overworld/overworld.obj.zst",
     {640, 110, 100},
     {450, 70, 400},
     60.0f,
     {500, 600, 100}},
}};

// The known scene that a name or a file stands for.
const KnownScene* find_known(const std::string& name) {
    for (const KnownScene& known : kKnownScenes) {
        if (name == known.name || name.ends_with(std::string("/") + known.file))
            return &known;
    }
    return nullptr;
}

std::optional<fs::path> locate(const char* file, std::span<const fs::path> folders) {
    for (const fs::path& folder : folders) {
        std::error_code ignored;
        if (fs::is_regular_file(folder / file, ignored))
            return folder / file;
    }
    return std::nullopt;
}

glm::vec3 light_position(const scene::Scene& scene, const scene::Bounds& bounds) {
    const scene::Light& light = scene.lights.front();
    if (light.kind != scene::LightKind::directional)
        return light.position;
    return 0.5f * (bounds.lo + bounds.hi) - light.direction * bounds.diagonal();
}

// A case is called by the folder of a file when its stem is the usual nothing-saying one.
std::string case_name(const std::string& name) {
    const fs::path path(name);
    std::string stem = path.filename().string();
    stem.erase(std::min(stem.find('.'), stem.size()));
    const bool bare = stem == "scene" && path.has_parent_path();
    return bare ? path.parent_path().filename().string() : stem;
}

SurfacePoint surface_point(const scene::Scene& scene, const Surface& surface,
                           const glm::vec3& origin, const glm::vec3& direction, float t) {
    const scene::Mesh& mesh = scene.meshes[surface.mesh];
    const scene::Transform& transform = scene.instances[surface.instance].world_from_object;
    glm::vec3 p[3];
    for (int i = 0; i < 3; ++i)
        p[i] = transform.apply(mesh.positions[mesh.triangles[surface.triangle][i]]);
    glm::vec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    const float length = glm::length(normal);
    // A sliver without an area in fp32 looks at the ray.
    normal = length > 0.0f ? normal / length : -direction;
    if (glm::dot(normal, direction) > 0.0f)
        normal = -normal;
    return {origin + direction * t, normal};
}

} // namespace

std::vector<fs::path> scene_folders(std::span<const std::string> given) {
    std::vector<fs::path> folders(given.begin(), given.end());
    if (const char* path = std::getenv("MACULA_SCENE_PATH")) {
        std::istringstream parts(path);
        for (std::string part; std::getline(parts, part, ':');) {
            if (!part.empty())
                folders.emplace_back(part);
        }
    }
    folders.emplace_back("../shared/scenes");
    return folders;
}

std::vector<std::string> default_scenes(std::span<const fs::path> folders) {
    std::vector<std::string> scenes{"atrium", "voxel_city"};
    for (const KnownScene& known : kKnownScenes) {
        if (locate(known.file, folders))
            scenes.emplace_back(known.name);
    }
    return scenes;
}

Case open_case(const std::string& name, std::span<const fs::path> folders) {
    Case made;
    const KnownScene* known = find_known(name);
    std::string file = name;
    if (known != nullptr && name == known->name) {
        if (const std::optional<fs::path> found = locate(known->file, folders))
            file = found->string();
    }
    scene::LoadOptions options;
    options.search_path.assign(folders.begin(), folders.end());
    made.scene = scene::load(file, options);
    made.name = known != nullptr ? std::string(known->name) : case_name(name);
    made.bounds = made.scene.bounds();
    if (known != nullptr) {
        made.camera = pinhole(known->eye, known->target, {0, 1, 0}, known->vertical_fov_degrees, 1);
        made.light = known->light;
    } else {
        const scene::Camera& camera = made.scene.cameras.front();
        made.camera =
            pinhole(camera.eye, camera.target, camera.up, camera.vertical_fov_degrees, 1.0f);
        made.light = light_position(made.scene, made.bounds);
    }
    return made;
}

RaySet make_rays(kernel::RayClass ray_class, const Case& scene_case,
                 std::span<const SurfacePoint> points, const RayOptions& options) {
    const float diagonal = scene_case.bounds.diagonal();
    // The sparse view and its support grid shrink with the size, so that tests stay short.
    const auto scaled = [&](std::uint32_t full) {
        return std::max(1U, static_cast<std::uint32_t>(std::uint64_t{full} * options.size / 1024));
    };
    switch (ray_class) {
    case kernel::RayClass::shadow:
        return shadow_rays(points, scene_case.light, diagonal);
    case kernel::RayClass::ambient_occlusion:
        return ambient_occlusion_rays(points, 0.15f * diagonal, diagonal, options.seed);
    case kernel::RayClass::diffuse:
        return diffuse_rays(points, diagonal, options.seed);
    case kernel::RayClass::random:
        return random_rays(scene_case.bounds, options.size * options.size, options.seed);
    case kernel::RayClass::sparse:
        return sparse_rays(dk2_left(scene_case.camera), scaled(kDk2Width), scaled(kDk2Height),
                           scaled(256), scaled(318), {}, options.seed);
    case kernel::RayClass::primary:
        break;
    }
    return primary_rays(scene_case.camera, options.size);
}

std::vector<SurfacePoint> surface_points(const Case& scene_case, const RaySet& rays,
                                         const EmbreeRays& traced) {
    std::vector<SurfacePoint> points;
    for (std::uint32_t i = 0; i < rays.count; ++i) {
        const EmbreeHit hit = traced.hit(i);
        if (hit.surface)
            points.push_back(surface_point(scene_case.scene, *hit.surface, rays.origin(i),
                                           rays.direction(i), hit.t));
    }
    return points;
}

} // namespace macula::bench
