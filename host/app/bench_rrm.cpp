#include "host/app/bench_rrm.hpp"

#ifdef MACULA_WITH_BENCH

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <tuple>

#include "bench/rrm.hpp"
#include "host/app/bench_options.hpp"
#include "host/app/render_options.hpp"

namespace macula::app {
namespace {

using bench::RrmRow;

struct Options {
    bench::RrmOptions rrm;
    std::string size, positions = "8x5";
    bool json = false;
};

void add_options(CLI::App& command, Options& options) {
    bench::RrmOptions& r = options.rrm;
    add_device_option(command, r.device);
    const auto number = [&](const char* option, auto& value, const char* meaning) {
        command.add_option(option, value, meaning)->capture_default_str();
    };
    command
        .add_option("--cases", r.cases,
                    "whitted, \"whitted secondary\", bunny, physics, separated by commas (default: "
                    "all)")
        ->delimiter(',');
    command.add_option("--scene-path", r.scene_path,
                       "Folder of bunny/; may be repeated; those of MACULA_SCENE_PATH and "
                       "../shared/scenes follow. Without it the bunny is left out");
    number("--display", r.display, "Whose middle eye is rendered");
    command.add_option("--size", options.size, "WIDTHxHEIGHT in pixels (default: the display's)");
    number("--positions", options.positions, "COLUMNSxROWS of the grid of foveal positions");
    number("--frames", r.frames, "Measured frames at each position");
    number("--warm-up", r.warm_up, "Frames before them");
    number("--n", r.n, "Blocks of a refresh group, 1..132");
    number("--fovea", r.fovea, "Degrees from the gaze to the foveal rectangle's edges");
    number("--depth", r.depth, "Levels of reflected and refracted rays of \"whitted secondary\"");
    number("--seed", r.seed, "Of all that is random");
    command.add_flag("--sweep", r.sweep, "Also N from 12 to 132: figure 9");
    command.add_flag("--quality", r.quality, "Also scores of N = 12 and N = 132: figure 10");
    number("--quality-frames", r.quality_frames, "Frames that are scored");
    number("--gaze", r.gaze, "Of the frames that are scored, as of macula render");
    number("--physics-frames", r.physics_frames, "Frames of the physics");
    command.add_option("--resume", r.resume,
                       "File of JSON lines: rows in it are not measured again, new ones are added");
    command.add_flag("--json", options.json, "One JSON line for each row");
}

int run(const Options& options) {
    bench::RrmOptions rrm = options.rrm;
    std::tie(rrm.width, rrm.height) = parse_size(options.size);
    std::tie(rrm.columns, rrm.rows) = parse_size(options.positions);
    rrm.bvh_cache = bvh_cache_folder();
    bench::RrmProgress progress;
    progress.note = progress_line();
    progress.row = [&](const RrmRow& row, bool) {
        fmt::print("{}", options.json ? json_line(row) + "\n" : bench::rrm_line(row));
        std::fflush(stdout);
    };
    progress.skipped = [](const std::string& name, const std::string& reason) {
        fmt::print(stderr, "{}: left out: {}\n", name, reason);
    };
    if (!options.json)
        fmt::print("{}", bench::rrm_heading());
    const auto rows = run_rrm(rrm, progress);
    if (!options.json)
        fmt::print("{}", bench::rrm_summary(rows));
    return 0;
}

} // namespace

Run add_bench_rrm(CLI::App& command) {
    auto options = std::make_shared<Options>();
    add_options(command, *options);
    return [options] { return run(*options); };
}

} // namespace macula::app

#endif
