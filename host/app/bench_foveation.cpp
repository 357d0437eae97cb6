#include "host/app/bench_foveation.hpp"

#ifdef MACULA_WITH_BENCH

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <tuple>

#include "bench/figure5.hpp"
#include "bench/table1.hpp"
#include "host/app/bench_options.hpp"
#include "host/app/render_options.hpp"

namespace macula::app {
namespace {

using bench::FoveationOptions;
using bench::FoveationProgress;
using bench::FoveationRow;

struct Options {
    FoveationOptions flight;
    std::vector<std::string> lights;
    std::string size;
    bool json = false;
};

void add_options(CLI::App& command, Options& options) {
    FoveationOptions& f = options.flight;
    add_device_option(command, f.device);
    command
        .add_option("--scenes,--scene", f.scenes,
                    "Built-in scenes, files, sibenik or sponza_crytek, separated by commas")
        ->delimiter(',');
    command.add_option("--scene-path", f.scene_path,
                       "Folder of sibenik/ and sponza_crytek/; may be repeated; those of "
                       "MACULA_SCENE_PATH and ../shared/scenes follow");
    command
        .add_option("--lights", options.lights,
                    "point, area, soft, ao, separated by commas (default: all but soft)")
        ->delimiter(',');
    command.add_option("--frames", f.frames, "Measured frames")->capture_default_str();
    command.add_option("--segments", f.segments, "Stretches of the path that the frames lie in")
        ->capture_default_str();
    command.add_option("--warm-up", f.warm_up, "Frames before each stretch that do not count")
        ->capture_default_str();
    command.add_option("--display", f.display, "Field of view and size")->capture_default_str();
    command.add_option("--size", options.size, "WIDTHxHEIGHT in pixels (default: the display's)");
    command.add_option("--gaze", f.gaze, "As --gaze of render; the paper's benchmark: centre")
        ->capture_default_str();
    command.add_option("--resume", f.resume,
                       "File of JSON lines: rows in it are not measured again, new ones are added");
    command.add_flag("--json", options.json, "One JSON line for each row");
}

/// What both benchmarks take from the command line. Throws std::invalid_argument.
FoveationOptions parse(const Options& options) {
    FoveationOptions flight = options.flight;
    flight.lights = parse_lights(options.lights);
    std::tie(flight.width, flight.height) = parse_size(options.size);
    flight.bvh_cache = bvh_cache_folder();
    return flight;
}

void print(const std::string& text) {
    fmt::print("{}", text);
    std::fflush(stdout);
}

int run_table1(const Options& options) {
    FoveationOptions flight = parse(options);
    if (flight.scenes.empty())
        flight.scenes = bench::table1_scenes(flight.scene_path);
    FoveationProgress progress;
    progress.note = progress_line();
    progress.more = bench::paper_fields;
    progress.row = [&](const FoveationRow& row, bool) {
        print(options.json ? json_line(row, bench::paper_fields(row)) + "\n"
                           : bench::table1_lines(row));
    };
    if (!options.json)
        print(bench::table1_heading());
    const auto rows = run_foveation(flight, {bench::table1_region()}, progress);
    if (!options.json)
        print(bench::table1_summary(rows));
    return 0;
}

int run_figure5(const Options& options) {
    FoveationOptions flight = parse(options);
    if (flight.scenes.empty())
        flight.scenes = bench::figure5_scenes(flight.scene_path);
    FoveationProgress progress;
    progress.note = progress_line();
    progress.row = [&](const FoveationRow& row, bool) {
        print(options.json ? json_line(row) + "\n" : bench::figure5_line(row));
    };
    if (!options.json)
        print(bench::figure5_heading());
    run_foveation(flight, bench::figure5_regions(), progress);
    return 0;
}

} // namespace

Run add_bench_table1(CLI::App& command) {
    auto options = std::make_shared<Options>();
    add_options(command, *options);
    return [options] { return run_table1(*options); };
}

Run add_bench_figure5(CLI::App& command) {
    auto options = std::make_shared<Options>();
    add_options(command, *options);
    return [options] { return run_figure5(*options); };
}

} // namespace macula::app

#endif
