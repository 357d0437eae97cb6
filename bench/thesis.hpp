// `macula bench thesis`: tables 5.1 to 5.4 and figures 5.1 and 5.2 of Mrad, "Image Upscaling for
// Ray Traced Foveated Rendering" (2022), with our figures beside the thesis's.
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

#include "bench/thesis_views.hpp"
#include "host/frame/lights.hpp"
#include "host/frame/timings.hpp"

namespace macula::bench {

// The stages of the thesis's section 5.2. Its shader remaps and anti-aliases at once; ours are two.
enum class ThesisStage : std::uint8_t { ray_tracing, remap, taa, upscale };
inline constexpr std::size_t kThesisStages = 4;
// As they are called in JSON: ray_tracing, remap, taa, upscale.
const char* name(ThesisStage stage);
ThesisStage thesis_stage(std::string_view stage);

struct ThesisOptions {
    std::string device;
    std::vector<std::string> views;            // names as thesis_views() has them; empty: all
    std::vector<std::string> modes;            // of thesis_modes(); empty: all
    std::vector<std::string> scene_path;       // folders
    std::optional<frame::LightMode> lights;    // without: soft
    std::uint32_t width = 1920, height = 1080; // pixels
    std::uint32_t light_samples = 3;           // shadow rays a light
    std::uint32_t warm_up = 64;                // frames of the still view before it is judged
    std::uint32_t frames = 12;                 // whose times count, 1..100000
    std::uint32_t orbit = 6;                   // frames in motion, judged for flicker; 0: none
    std::uint32_t reference_spp = 36, orbit_spp = 9; // of what they are compared with
    bool sweep = false;                              // of the disk's radius: figure 5.2
    std::uint32_t seed = 0;
    std::filesystem::path bvh_cache; // folder; empty: none
    std::filesystem::path resume;    // rows that are there already and new ones; empty: none
};

// A mode in a view. Times are medians over the frames of the still view.
struct ThesisRow {
    std::string scene, view, mode; // scene: the thesis's; view: "central", ...
    std::string ours;              // what stands for it
    frame::LightMode lights = frame::LightMode::point;
    std::uint32_t width = 0, height = 0, frames = 0, warm_up = 0;
    double ms = 0.0; // by the device's clock, where it has one
    std::array<double, kThesisStages> stage_ms{};
    double samples = 0.0, rays = 0.0; // camera rays, all rays; a frame
    double flip_weighted_median = 0.0, flip_mean = 0.0;
    // Of the lightness, outside of the disk: in motion beyond the reference's own, and at rest.
    std::optional<double> flicker, instability;
    double flicker_still = 0.0;
    std::optional<double> disk, predicted; // of the sweep: half diagonals; samples by equation 5.1
    std::string device, driver, commit;
};
// One line without a line end, with what the thesis has; read back by parse_thesis_row, which
// throws std::invalid_argument.
std::string json_line(const ThesisRow& row);
ThesisRow parse_thesis_row(const std::string& line);

// Samples that equation 5.1 expects of a disk of that radius (half diagonals) around the centre of
// the image, with a buffer of the image's size divided by sigma.
double predicted_samples(std::uint32_t width, std::uint32_t height, double disk, double alpha,
                         double sigma);

struct ThesisProgress {
    std::function<void(const std::string& line)> note = [](const std::string&) {};
    std::function<void(const ThesisRow&, bool is_new)> row = [](const ThesisRow&, bool) {};
};

// Throws std::invalid_argument for options that make no sense, scene::SceneError, compute::Error,
// std::runtime_error for a resume file that cannot be read or written.
std::vector<ThesisRow> run_thesis(const ThesisOptions& options, const ThesisProgress& progress);

std::string thesis_heading();
std::string thesis_line(const ThesisRow& row);
// Ratios, and the targets with what became of them.
std::string thesis_summary(std::span<const ThesisRow> rows);

} // namespace macula::bench
