// Quality and time of methods along fly-throughs: what `macula bench quality` measures.
// docs/quality.md says how.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/frame/lights.hpp"
#include "host/report/quality_case.hpp"
#include "host/stage/foveated.hpp"

namespace macula::bench {

// How weier is to work: a foveal region configuration (Weier et al. 2016, section 4.2.1) and other
// parameters.
struct QualityWeier {
    std::string frc = "medium";  // or as it was given
    std::string changes;         // as parse_weier_changes() takes them; empty: none
    stage::WeierOptions options; // both, in numbers

    std::string name() const { return changes.empty() ? frc : frc + " " + changes; }
};

// "KEY=VALUE,..." with eps-depth, eps-lum, eps-edge, eps-stretch, eps-merge, k-min, k-max or t-max,
// which mean what they do as options of `macula render`. Throws std::invalid_argument.
void parse_weier_changes(const std::string& list, stage::WeierOptions& options);

struct QualityOptions {
    std::string device;
    std::vector<std::string> scenes;      // of load_fly_through()
    std::vector<std::string> scene_path;  // folders
    std::vector<frame::LightMode> lights; // empty: area
    // Of method::methods(), with their defaults but for what follows; empty: full, weier, lowres.
    std::vector<std::string> methods;
    std::vector<QualityWeier> weier;     // and what lowres is to equal; empty: medium
    std::vector<std::uint32_t> spp;      // of full; empty: 1
    std::vector<std::string> equal;      // of lowres: samples, time; empty: both
    std::string display = "dk2";         // its middle eye is rendered
    std::uint32_t width = 0, height = 0; // pixels; 0: the display's
    // A recording with gaze and head (an importer's format); empty: that of wearer.hpp.
    std::filesystem::path trace;
    std::string gaze, tracker;        // as those of `macula render`; an empty gaze: the trace's
    std::string head;                 // FILE.csv, "scene" (the path alone); empty: the trace's
    std::uint32_t frames = 12;        // measured, 1..100000
    std::uint32_t segments = 3;       // consecutive stretches of the path, 1..frames
    std::uint32_t warm_up = 8;        // frames before each that do not count, 1..1000
    std::uint32_t reference_spp = 36; // 1..65536
    std::optional<std::uint32_t> light_samples; // as render::Options has it
    std::uint32_t ambient_occlusion_samples = 16, seed = 0;
    std::uint32_t pictures = 2;            // frames with pictures, for each case
    std::filesystem::path bvh_cache;       // folder; empty: none
    std::filesystem::path reference_cache; // folder; empty: none
    std::filesystem::path results;         // JSON lines; pictures lie beside it; empty: no files
};

struct QualityProgress {
    std::function<void(const std::string& line)> note = [](const std::string&) {};
    // For each case, as soon as it is finished or found in the results.
    std::function<void(const report::QualityCase&, bool is_new)> done =
        [](const report::QualityCase&, bool) {};
};

// Runs every scene with all lights and methods; cases that are in `results` already are not run
// again, new ones are added as whole lines. Throws std::invalid_argument for options that make no
// sense, scene::SceneError, compute::Error, std::runtime_error for files.
std::vector<report::QualityCase> run_quality(const QualityOptions& options,
                                             const QualityProgress& progress);

// The same in the shape of Google Benchmark's JSON, for tools that read that.
std::string google_benchmark(const std::vector<report::QualityCase>& cases);

} // namespace macula::bench
