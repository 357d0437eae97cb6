// `macula bench rrm`: figures 9 to 11 of Smith, Booth and Bailey, "Refresh Rate Modulation for
// Perceptually Optimized Computer Graphics" (2014), and its physics, with our figures beside the
// paper's.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/physics.hpp"
#include "bench/stage_groups.hpp"

namespace macula::bench {

struct RrmOptions {
    std::string device;
    std::vector<std::string> cases;        // of rrm_cases(); empty: all
    std::vector<std::string> scene_path;   // folders
    std::string display = "desktop_1080p"; // its middle eye is rendered
    std::uint32_t width = 0, height = 0;   // pixels; 0: the display's
    std::uint32_t columns = 8, rows = 5;   // of the grid of foveal positions, 1..1000 each
    std::uint32_t frames = 3, warm_up = 1; // a position, measured (1..1000) and before them
    std::uint32_t n = 12;                  // blocks of a refresh group, 1..132
    float fovea = 5.0f;                    // degrees from the gaze to the rectangle's edges
    std::uint32_t depth = 4;               // levels of secondary rays, where a case has them
    bool sweep = false;                    // of N: figure 9
    bool quality = false;                  // scores of N = 12 and N = 132: figure 10
    std::uint32_t quality_frames = 6;      // judged, 2..1000
    std::string gaze = "target";           // of the quality; as --gaze of `macula render`
    std::uint32_t physics_frames = 1000;   // 1..100000
    std::uint32_t seed = 0;
    std::filesystem::path bvh_cache; // folder; empty: none
    std::filesystem::path resume;    // rows that are there already and new ones; empty: none
};

// A scene of the paper, or what stands for it.
struct RrmCase {
    std::string_view name, scene;
    bool secondary;        // reflected and refracted rays
    double paper_speedup;  // figure 11
    double target_speedup; // what ours is to reach
    double paper_fps_full, paper_fps_ours;
};
// "whitted", "whitted secondary", "bunny".
std::span<const RrmCase> rrm_cases();

// Times and samples of a method beside `full`. Those of `full` are medians over its frames, since
// the gaze does not change them; ours are means over the positions of their medians there.
struct RrmSpeed {
    bool device_clock = true; // false: the driver's profiling has no times, these are the host's
    double ms_full = 0.0, ms_ours = 0.0, wall_ms_full = 0.0, wall_ms_ours = 0.0;
    std::array<double, kStageGroups> ms{}; // of ours, by group
    double mean_rate = 0.0; // of ours, frames/s: mean over the positions of 1000 / ms
    double samples_full = 0.0, samples_ours = 0.0, rays_full = 0.0, rays_ours = 0.0; // a frame

    double fps_full() const { return 1000.0 / ms_full; }
    double fps_ours() const { return 1000.0 / ms_ours; }
    double speedup() const { return ms_full / ms_ours; }
    double wall_speedup() const { return wall_ms_full / wall_ms_ours; }
    // The part of what fewer samples could save that is saved.
    double efficiency() const { return speedup() * samples_ours / samples_full; }
};

// Beside `full` at one sample a pixel, along a path.
struct RrmQuality {
    double flip = 0.0, foveated_flip = 0.0; // means
    double flicker = 0.0, instability = 0.0;
    double samples = 0.0; // a frame
};

// One of the three is set.
struct RrmRow {
    std::string name;          // of a case; "sweep", "quality", "physics"
    std::string method, scene; // method: "rrm", "lowres_rings"; of physics: none
    std::uint32_t n = 0;       // of rrm; of lowres_rings: of the rrm that it has as many samples as
    std::uint32_t depth = 0, width = 0, height = 0, columns = 0, rows = 0, frames = 0;
    std::uint32_t warm_up = 0, seed = 0;
    float fovea = 0.0f;                // degrees
    std::array<float, 3> ring_edges{}; // of lowres_rings, degrees
    std::string gaze;                  // of the quality
    std::string display, device, driver, commit;
    std::optional<RrmSpeed> speed;
    std::optional<RrmQuality> quality;
    std::optional<PhysicsResult> physics;
};
// One line without a line end; read back by parse_rrm_row, which throws std::invalid_argument.
std::string json_line(const RrmRow& row);
RrmRow parse_rrm_row(const std::string& line);

struct RrmProgress {
    std::function<void(const std::string& line)> note = [](const std::string&) {};
    // For each row, as soon as it is measured or found in `resume`.
    std::function<void(const RrmRow& row, bool is_new)> row = [](const RrmRow&, bool) {};
    // A case that is left out, and why.
    std::function<void(const std::string& name, const std::string& reason)> skipped =
        [](const std::string&, const std::string&) {};
};

// Throws std::invalid_argument for options that make no sense, scene::SceneError, compute::Error,
// std::runtime_error for a resume file that cannot be read or written.
std::vector<RrmRow> run_rrm(const RrmOptions& options, const RrmProgress& progress);

std::string rrm_heading();
std::string rrm_line(const RrmRow& row);
// The targets with what became of them, and what a figure is worth.
std::string rrm_summary(std::span<const RrmRow> rows);

} // namespace macula::bench
