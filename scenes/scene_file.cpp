// Macula's own scene files: TOML that names what to load and says how to look at it. The format is
// described in docs/scene-file.md. Every message gives file, line and key.
#include <algorithm>
#include <cstdlib>

#include "scenes/display.hpp"
#include "scenes/formats.hpp"
#include "scenes/procedural/registry.hpp"
#include "scenes/scene_file_physics.hpp"
#include "scenes/scene_motion.hpp"
#include "scenes/scene_overrides.hpp"
#include "scenes/toml_reader.hpp"

namespace macula::scene {
namespace {

constexpr int kMaxNesting = 8; // scene files that name scene files

std::vector<std::filesystem::path> search_folders(const std::filesystem::path& file,
                                                  const LoadOptions& options) {
    std::vector<std::filesystem::path> folders;
    folders.push_back(file.has_parent_path() ? file.parent_path() : std::filesystem::path("."));
    folders.insert(folders.end(), options.search_path.begin(), options.search_path.end());
    const char* variable = std::getenv("MACULA_SCENE_PATH");
    std::string_view list = variable != nullptr ? variable : "";
    while (!list.empty()) {
        const std::size_t end = std::min(list.find(':'), list.size());
        if (end > 0)
            folders.emplace_back(list.substr(0, end));
        list.remove_prefix(std::min(end + 1, list.size()));
    }
    return folders;
}

std::filesystem::path find_file(const TomlTable& table, const char* key, const std::string& wanted,
                                const std::filesystem::path& file, const LoadOptions& options) {
    std::error_code error;
    if (std::filesystem::path(wanted).is_absolute())
        return wanted;
    std::string tried;
    for (const std::filesystem::path& folder : search_folders(file, options)) {
        std::filesystem::path candidate = folder / wanted;
        if (std::filesystem::is_regular_file(candidate, error))
            return candidate;
        tried += (tried.empty() ? "" : ", ") + folder.string();
    }
    table.fail(key, "'" + wanted + "' is in none of: " + tried +
                        " (--scene-path or MACULA_SCENE_PATH name more folders)");
}

Scene load_named(const TomlTable& root, const std::filesystem::path& path,
                 const LoadOptions& options) {
    const std::optional<std::string> file = root.string("file");
    const std::optional<std::string> built_in = root.string("procedural");
    if (file.has_value() == built_in.has_value())
        root.fail("file", "exactly one of 'file' and 'procedural' must be given");
    if (file) {
        for (const char* key : {"seed", "size"})
            if (root.has(key))
                root.fail(key, "only procedural scenes have it");
        LoadOptions inner = options;
        if (++inner.nesting > kMaxNesting)
            root.fail("file", "scene files name each other in a circle");
        read_motion_options(root, inner);
        return load_file(find_file(root, "file", *file, path, options), inner);
    }
    procedural::SceneParams params;
    params.seed = root.integer("seed", 0, INT64_MAX).value_or(options.seed);
    params.size =
        static_cast<std::uint32_t>(root.integer("size", 0, UINT32_MAX).value_or(options.size));
    std::optional<Scene> scene = procedural::make(*built_in, params);
    if (!scene)
        root.fail("procedural", "there is no built-in scene '" + *built_in + "'");
    return std::move(*scene);
}

Light read_light(const TomlTable& table) {
    static constexpr KeyedValue<LightKind> kKinds[] = {{"point", LightKind::point},
                                                       {"directional", LightKind::directional},
                                                       {"spherical", LightKind::spherical},
                                                       {"rectangle", LightKind::rectangle}};
    Light light;
    light.kind = table.choice<LightKind>("kind", kKinds).value_or(LightKind::point);
    const bool directional = light.kind == LightKind::directional;
    const bool rectangle = light.kind == LightKind::rectangle;
    if (directional) {
        light.direction = table.required_vec3("direction");
        if (!(glm::length(light.direction) > 0.0f))
            table.fail("direction", "it has no length");
        light.direction = glm::normalize(light.direction);
        light.angle = table.number("angle", 0.0, 80.0).value_or(light.angle);
    } else {
        light.position = table.required_vec3("position");
        light.radius = table.number("radius", 0.0, 1e18).value_or(0.0f);
        light.attenuation_distance = table.number("attenuation_distance", 0.0, 1e18).value_or(0.0f);
    }
    if (light.kind == LightKind::spherical && !(light.radius > 0.0f))
        table.fail("radius", "a spherical light needs one above 0");
    if (rectangle) {
        light.edge_u = table.required_vec3("edge_u");
        light.edge_v = table.required_vec3("edge_v");
        if (!(glm::length(glm::cross(light.edge_u, light.edge_v)) > 0.0f))
            table.fail("edge_u", "the rectangle has no area");
    }
    light.colour = table.colour("colour", 1e9).value_or(glm::vec3(1.0f));
    light.colour *= table.number("intensity", 0.0, 1e9).value_or(1.0f);
    table.reject_unknown();
    return light;
}

Camera read_camera(const TomlTable& table, std::size_t index) {
    Camera camera;
    camera.name = table.string("name").value_or("camera " + std::to_string(index));
    camera.eye = table.required_vec3("eye");
    camera.target = table.required_vec3("target");
    camera.up = table.vec3("up").value_or(glm::vec3(0, 1, 0));
    camera.vertical_fov_degrees =
        table.number("vertical_fov_degrees", 1.0, 170.0).value_or(camera.vertical_fov_degrees);
    if (camera.eye == camera.target)
        table.fail("target", "it is the same point as 'eye'");
    table.reject_unknown();
    return camera;
}

CameraPath read_path(const TomlTable& table) {
    CameraPath path;
    path.frames = static_cast<std::uint32_t>(table.integer("frames", 1, 10'000'000).value_or(1000));
    for (const TomlTable& key : table.tables("key")) {
        CameraKey frame;
        frame.frame = key.required_number("frame", 0.0, 1e7);
        frame.eye = key.required_vec3("eye");
        frame.target = key.required_vec3("target");
        if (frame.eye == frame.target)
            key.fail("target", "it is the same point as 'eye'");
        if (!path.keys.empty() && !(frame.frame > path.keys.back().frame))
            key.fail("frame", "it must be greater than that of the key before");
        key.reject_unknown();
        path.keys.push_back(frame);
    }
    if (path.keys.empty())
        table.fail("key", "a camera path needs at least one [[path.key]]");
    table.reject_unknown();
    return path;
}

// A built-in display's name, or where the file that describes one lies.
std::string read_display_name(const TomlTable& root, const std::string& name,
                              const std::filesystem::path& path, const LoadOptions& options) {
    std::string found = name;
    if (name.ends_with(".toml") || name.ends_with(".json"))
        found = find_file(root, "display", name, path, options).string();
    try {
        find_display(found);
    } catch (const std::exception& error) {
        root.fail("display", error.what());
    }
    return found;
}

// As --gaze takes it; a recording by where its file lies.
std::string read_gaze_spec(const TomlTable& root, const std::string& spec,
                           const std::filesystem::path& path, const LoadOptions& options) {
    constexpr std::string_view kTrace = "trace:", kRepeat = ":repeat";
    const bool repeat = spec.ends_with(kRepeat), named = spec.starts_with(kTrace);
    std::string file = spec.substr(named ? kTrace.size() : 0);
    if (repeat)
        file.resize(file.size() - std::min(kRepeat.size(), file.size()));
    if (!named && !file.ends_with(".csv"))
        return spec;
    return std::string(kTrace) + find_file(root, "gaze", file, path, options).string() +
           (repeat ? std::string(kRepeat) : "");
}

void read_view(const TomlTable& root, const std::filesystem::path& path, const LoadOptions& options,
               Scene& scene) {
    const std::vector<TomlTable> lights = root.tables("light"), cameras = root.tables("camera");
    if (!lights.empty())
        scene.lights.clear();
    for (const TomlTable& table : lights)
        scene.lights.push_back(read_light(table));
    if (!cameras.empty())
        scene.cameras.clear();
    for (const TomlTable& table : cameras)
        scene.cameras.push_back(read_camera(table, scene.cameras.size()));
    if (const std::optional<TomlTable> flight = root.table("path"))
        scene.path = read_path(*flight);
    if (const auto name = root.string("name"))
        scene.name = *name;
    if (const auto metres = root.number("metres_per_unit", 1e-9, 1e9))
        scene.metres_per_unit = *metres;
    if (const auto ambient = root.colour("ambient", 1e9))
        scene.ambient = *ambient;
    if (const auto background = root.colour("background", 1e9))
        scene.background = *background;
    if (const auto radius = root.number("ambient_occlusion_radius", 0.0, 1e18))
        scene.ambient_occlusion_radius = *radius;
    if (const auto display = root.string("display"))
        scene.display = read_display_name(root, *display, path, options);
    if (const auto gaze = root.string("gaze"))
        scene.gaze = read_gaze_spec(root, *gaze, path, options);
}

} // namespace

Scene load_scene_file(const std::string& text, const std::filesystem::path& path,
                      const LoadOptions& options) {
    const TomlDocument document(text, path.string());
    const TomlTable root = document.root();
    Scene scene = load_named(root, path, options);
    static constexpr KeyedValue<UpAxis> kAxes[] = {
        {"y", UpAxis::y}, {"z", UpAxis::z}, {"x", UpAxis::x}};
    const UpAxis up = root.choice<UpAxis>("up", kAxes).value_or(UpAxis::y);
    const float scale = root.number("scale", 1e-9, 1e9).value_or(1.0f);
    transform_scene(scene, up, scale);
    read_view(root, path, options, scene);
    read_motion(root, scene);
    if (const std::optional<TomlTable> physics = root.table("physics"))
        read_physics(*physics, scene);
    for (const TomlTable& table : root.tables("material"))
        override_material(table, scene);
    root.reject_unknown();
    return scene;
}

} // namespace macula::scene
