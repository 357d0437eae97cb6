/// The options of `macula render`, as the user gave them and as the engine takes them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/app/rrm_options.hpp"
#include "host/app/view_options.hpp"
#include "host/app/weier_options.hpp"
#include "host/render/renderer.hpp"
#include "scenes/scene.hpp"

namespace CLI {
class App;
}

namespace macula::app {

struct RenderOptions : ViewOptions {
    std::string scene, device, method = "full", camera, path = "scene", frames, lights = "point",
                               variant;
    std::uint32_t lanes = 0;
    std::uint32_t samples_per_pixel = 1, ambient_occlusion_samples = 16, seed = 0, depth = 1,
                  layers = 4;
    std::optional<std::uint32_t> light_samples;
    std::uint32_t scene_size = 0;
    std::uint64_t scene_seed = 1;
    float ambient_occlusion_radius = 0.0f, exposure = 1.0f, lod_bias = 0.0f;
    WeierOptions weier;
    RrmOptions rrm;
    stage::LogPolarOptions log_polar;
    method::TemporalOptions temporal;
    stage::RingOptions rings;
    std::vector<std::string> scene_path, formats = {"exr", "png"}, aovs;
    std::filesystem::path out = ".";
    bool json = false, hash = false, resume = false, list_variants = false, list_aovs = false;

    void add_to(CLI::App& command);
};

/// "bvh" in the user's cache folder; empty when there is none.
std::filesystem::path bvh_cache_folder();

/// Frames [first, end).
struct FrameRange {
    std::uint32_t first = 0, end = 1;
};

/// "A:B" (frames A to B - 1) or "A"; empty: frame 0. Throws std::invalid_argument.
FrameRange parse_frames(const std::string& text);

/// The scene with the camera and path that the options ask for. Throws what scene::load throws,
/// and std::invalid_argument for an unknown camera or path.
scene::Scene load_scene(const RenderOptions& options);

/// Throws std::invalid_argument that names the option.
render::Options engine_options(const RenderOptions& options);

} // namespace macula::app
