#include "bench/wearer.hpp"

#include <stdexcept>

#include "bench/cases.hpp"
#include "scenes/gaze/import.hpp"
#include "scenes/gaze/spec.hpp"

namespace macula::bench {
namespace {

namespace fs = std::filesystem;

// The recording that is asked for, or the usual one where it is found; else empty.
fs::path trace_of(const QualityOptions& options) {
    if (!options.trace.empty())
        return options.trace;
    for (const fs::path& folder : scene_folders(options.scene_path)) {
        fs::path found = folder / ".." / "traces" / kDefaultTrace;
        std::error_code ignored;
        if (fs::is_regular_file(found, ignored))
            return found;
    }
    return {};
}

void take_trace(Wearer& wearer, const fs::path& file, const QualityOptions& options) {
    scene::ImportedTrace trace = scene::import_trace(file, "");
    const std::string name = "recording " + file.filename().string();
    if (options.gaze.empty()) {
        if (trace.gaze.samples.empty())
            throw std::invalid_argument("--trace " + file.string() +
                                        ": it holds no gaze; --gaze says where to look");
        wearer.gaze = scene::recorded_gaze(std::move(trace.gaze), scene::AtEnd::hold);
        wearer.gaze_name = name;
    }
    if (options.head.empty() && !trace.head.samples.empty()) {
        wearer.head.emplace(std::move(trace.head));
        wearer.head_name = name + " on the scene's path";
    }
}

} // namespace

Wearer wearer_of(const QualityOptions& options, const scene::Display& display) {
    Wearer wearer;
    wearer.head_name = "scene's path";
    const fs::path trace = trace_of(options);
    if (!trace.empty() && (options.gaze.empty() || options.head.empty()))
        take_trace(wearer, trace, options);
    if (!options.head.empty() && options.head != "scene") {
        wearer.head.emplace(scene::read_head_csv(options.head));
        wearer.head_name =
            "recording " + fs::path(options.head).filename().string() + " on the scene's path";
    }
    if (!wearer.gaze) {
        wearer.gaze = scene::parse_gaze(options.gaze.empty() ? "synthetic" : options.gaze,
                                        {display, scene::Eye::mono, {}});
        wearer.gaze_name = wearer.gaze->describe();
    }
    if (!options.tracker.empty())
        wearer.gaze_name += ", tracker " + options.tracker;
    wearer.gaze = scene::tracked(std::move(wearer.gaze), scene::parse_tracker(options.tracker));
    return wearer;
}

} // namespace macula::bench
