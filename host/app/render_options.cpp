#include "host/app/render_options.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <stdexcept>
#include <tuple>

#include "host/app/aov.hpp"
#include "host/app/command.hpp"
#include "host/app/log_polar_options.hpp"
#include "host/app/ring_options.hpp"
#include "host/app/temporal_options.hpp"
#include "host/kernel/program_cache.hpp"
#include "scenes/load.hpp"

namespace macula::app {
namespace {

[[noreturn]] void refuse(const char* option, const std::string& value, const char* expected) {
    throw std::invalid_argument(fmt::format("{} \"{}\": {}", option, value, expected));
}

// "x,y,z:x,y,z[:fov]" or the name or index of one of the scene's cameras.
scene::Camera parse_camera(const std::string& text, const scene::Scene& scene) {
    scene::Camera camera = scene.cameras.front();
    float* e = &camera.eye.x;
    float* t = &camera.target.x;
    int end = 0;
    if (std::sscanf(text.c_str(), "%f,%f,%f:%f,%f,%f%n", e, e + 1, e + 2, t, t + 1, t + 2, &end) ==
        6) {
        const char* rest = text.c_str() + end;
        int used = 0;
        if (*rest == '\0')
            return camera;
        if (std::sscanf(rest, ":%f%n", &camera.vertical_fov_degrees, &used) == 1 &&
            rest[used] == '\0')
            return camera;
    }
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
        if (text == scene.cameras[i].name || text == std::to_string(i))
            return scene.cameras[i];
    }
    refuse("--camera", text,
           "neither EYE:TARGET[:FOV] as x,y,z:x,y,z:degrees nor one of the scene's cameras");
}

// --head names a path too, unless it is a recording.
void choose_path(scene::Scene& scene, const RenderOptions& options) {
    const bool by_head = !options.head.empty() && !head_is_recorded(options);
    const std::string& path = by_head ? options.head : options.path;
    if (path == "still") {
        scene.path = {};
    } else if (path != "scene") {
        scene::LoadOptions geometry_only;
        geometry_only.textures = false;
        scene.path = scene::load(path, geometry_only).path;
        if (scene.path.keys.empty())
            refuse(by_head ? "--head" : "--path", path, "this scene file has no camera path");
    }
}

} // namespace

std::filesystem::path bvh_cache_folder() {
    const std::filesystem::path cache = kernel::ProgramCache::default_folder();
    return cache.empty() ? cache : cache / "bvh";
}

FrameRange parse_frames(const std::string& text) {
    if (text.empty())
        return {};
    unsigned first = 0, end = 0;
    int used = 0;
    if (std::sscanf(text.c_str(), "%u:%u%n", &first, &end, &used) == 2 &&
        text[static_cast<std::size_t>(used)] == '\0' && first < end)
        return {first, end};
    if (std::sscanf(text.c_str(), "%u%n", &first, &used) == 1 &&
        text[static_cast<std::size_t>(used)] == '\0' && first != ~0u)
        return {first, first + 1};
    refuse("--frames", text, "A:B (frames A to B - 1, A < B) or one frame was expected");
}

scene::Scene load_scene(const RenderOptions& options) {
    scene::LoadOptions load;
    load.seed = options.scene_seed;
    load.size = options.scene_size;
    for (const std::string& folder : options.scene_path)
        load.search_path.emplace_back(folder);
    scene::Scene scene = scene::load(options.scene, load);
    choose_path(scene, options);
    if (!options.camera.empty()) {
        scene.cameras = {parse_camera(options.camera, scene)};
        scene.path = {};
    }
    return scene;
}

render::Options engine_options(const RenderOptions& options) {
    render::Options engine;
    const auto lights = frame::parse_light_mode(options.lights);
    if (!lights)
        refuse("--lights", options.lights, "point, area, soft or ao was expected");
    engine.lights = *lights;
    engine.method = options.method;
    engine.light_samples = options.light_samples;
    engine.ambient_occlusion_samples = options.ambient_occlusion_samples;
    engine.ambient_occlusion_radius = options.ambient_occlusion_radius;
    engine.samples_per_pixel = options.samples_per_pixel;
    engine.seed = options.seed;
    engine.depth = options.depth;
    engine.layers = options.layers;
    engine.lod_bias = options.lod_bias;
    engine.variant = options.variant;
    engine.lanes = options.lanes;
    engine.weier = engine_options(options.weier);
    engine.lowres_scale = options.weier.lowres_scale;
    engine.log_polar = options.log_polar;
    engine.rrm = engine_options(options.rrm);
    engine.temporal = options.temporal;
    engine.rings = options.rings;
    std::tie(engine.width, engine.height) = size_of(options, engine.width, engine.height);
    for (const std::string& aov : options.aovs)
        engine.images.push_back(find_aov(aov).image);
    engine.geometry.cache_directory = bvh_cache_folder();
    return engine;
}

void RenderOptions::add_to(CLI::App& command) {
    command.add_option("scene", scene,
                       "Built-in scene or file (.obj .gltf .glb .toml, also .gz or .zst)");
    add_device_option(command, device);
    command.add_option("--method", method, "How frames are made")->capture_default_str();
    command.add_option("--spp", samples_per_pixel, "Samples per pixel")->capture_default_str();
    ViewOptions::add_to(command);
    command.add_option("--camera", camera, "EYE:TARGET[:FOV] as x,y,z:x,y,z:degrees, or a name");
    command.add_option("--path", path, "scene, still, or a scene file whose camera path to fly")
        ->capture_default_str();
    command.add_option("--frames", frames, "A:B, frames A to B - 1 of the path (default 0:1)");
    command.add_option("--lights", lights, "point, area, soft or ao")->capture_default_str();
    command.add_option("--light-samples", light_samples,
                       "Rays for each area light (default: 8; of --lights soft: 3)");
    command.add_option("--ao-samples", ambient_occlusion_samples, "Rays of ambient occlusion")
        ->capture_default_str();
    command.add_option("--ao-radius", ambient_occlusion_radius, "World units; 0: the scene's")
        ->capture_default_str();
    command.add_option("--layers", layers, "Blended surfaces kept along a ray")
        ->capture_default_str();
    command.add_option("--depth", depth, "Levels of reflected and refracted rays")
        ->capture_default_str();
    command.add_option("--lod-bias", lod_bias, "Levels that every texture lookup goes up")
        ->capture_default_str();
    command.add_option("--seed", seed, "Of all random numbers")->capture_default_str();
    command.add_option("--scene-seed", scene_seed, "Of a built-in scene")->capture_default_str();
    command.add_option("--scene-size", scene_size, "Of voxel_city: blocks; 0: its default")
        ->capture_default_str();
    command.add_option("--scene-path", scene_path, "Folder that scene files refer to (repeatable)");
    weier.add_to(command);
    add_log_polar_options(command, log_polar);
    rrm.add_to(command);
    add_temporal_options(command, temporal);
    add_ring_options(command, rings);
    command.add_option("--variant", variant, "Traversal variant for all rays");
    command
        .add_option("--lanes", lanes,
                    "Rays that a work-item of the shading kernels works on; 0: by device")
        ->check(CLI::IsMember({0, 1, 16}));
    command.add_option("--out", out, "Folder for the frames")->capture_default_str();
    command.add_option("--format", formats, "exr, png or both")->delimiter(',');
    command.add_option("--exposure", exposure, "Scale of the PNG's radiance")
        ->capture_default_str();
    command.add_option("--aov", aovs, "Further EXR channels, see --list-aovs")->delimiter(',');
    command.add_flag("--json", json, "One JSON line a frame");
    command.add_flag("--hash", hash, "Print `hash <hex>` of each frame's bits");
    command.add_flag("--resume", resume, "Write no frame whose files exist");
    command.add_flag("--list-variants", list_variants, "Why a traversal variant does not apply");
    command.add_flag("--list-aovs", list_aovs, "What --aov can name");
}

} // namespace macula::app
