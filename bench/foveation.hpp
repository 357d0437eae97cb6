// Fly-throughs by `full` and by foveated methods, frame beside frame: what `macula bench table1`
// and `macula bench figure5` measure.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/stage_groups.hpp"
#include "host/frame/lights.hpp"
#include "host/stage/foveated.hpp"

namespace macula::bench {

struct FoveationOptions {
    std::string device;
    std::vector<std::string> scenes;      // of load_fly_through()
    std::vector<std::string> scene_path;  // folders
    std::vector<frame::LightMode> lights; // empty: point, area, ambient occlusion
    std::string display = "dk2";          // its middle eye is rendered, as in the paper
    std::string gaze = "target";          // as --gaze of `macula render`; no depth: a single eye
    std::uint32_t width = 0, height = 0;  // pixels; 0: the display's
    std::uint32_t frames = 24;            // measured, 1..100000
    std::uint32_t segments = 6;           // consecutive stretches of the path, 1..frames
    std::uint32_t warm_up = 3;            // frames before each segment, not measured, 1..1000
    std::optional<std::uint32_t> light_samples;   // as render::Options has it: the paper's
    std::uint32_t ambient_occlusion_samples = 16; // the paper's
    std::filesystem::path bvh_cache;              // folder; empty: none
    std::filesystem::path resume; // rows that are there already and new ones; empty: none
};

// A foveal region configuration by name (section 4.2.1).
struct Region {
    const char* name;
    float r0, r1, p_min; // degrees, degrees, 0..1
};

// One scene and lighting with one foveal region, beside `full`. Times are medians over the frames,
// counts are means.
struct FoveationRow {
    std::string scene, frc;
    frame::LightMode lights = frame::LightMode::point;
    std::uint32_t width = 0, height = 0, frames = 0, segments = 0, warm_up = 0;
    std::uint64_t triangles = 0;
    double rays_full = 0.0, rays_ours = 0.0; // of all kinds, a frame
    double sampled = 0.0;                    // part of the pixels, 0..1
    // By the device's clock, all stages; by the wall clock where the device has none.
    double ms_full = 0.0, ms_ours = 0.0;
    bool device_clock = true;
    double wall_ms_full = 0.0, wall_ms_ours = 0.0;
    std::array<double, kStageGroups> ms{}; // of ours, by group
    double speedup = 0.0;                  // of the frames' own ratios, full / ours: their median
    double speedup_p10 = 0.0, speedup_p90 = 0.0;
    double wall_speedup = 0.0;
    double efficiency = 0.0; // speedup / (rays_full / rays_ours)
    std::string device, driver, commit, gaze;

    // Everything but ray tracing and shading, as part of a full frame.
    double overhead() const;
};

// One line without a line end; read back by parse_row, which throws std::invalid_argument.
// `more`: further fields as the inside of a JSON object ("\"a\":1"), or empty.
std::string json_line(const FoveationRow& row, const std::string& more = {});
FoveationRow parse_row(const std::string& line);

struct FoveationProgress {
    std::function<void(const std::string& line)> note = [](const std::string&) {};
    // For each row, as soon as it is measured or found in `resume`.
    std::function<void(const FoveationRow& row, bool is_new)> row = [](const FoveationRow&, bool) {
    };
    // Further fields of a row's line in `resume`, see json_line.
    std::function<std::string(const FoveationRow& row)> more = [](const FoveationRow&) {
        return std::string();
    };
};

// Measures every scene and lighting with every region; `full` and the regions' frames alternate.
// Scenes are those of load_fly_through (bench/foveation_scenes.hpp). Throws
// std::invalid_argument for options that make no sense, scene::SceneError, compute::Error,
// std::runtime_error for a resume file that cannot be read or written.
std::vector<FoveationRow> run_foveation(const FoveationOptions& options,
                                        const std::vector<Region>& regions,
                                        const FoveationProgress& progress);

} // namespace macula::bench
