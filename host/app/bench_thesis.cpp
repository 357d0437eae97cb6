#include "host/app/bench_thesis.hpp"

#ifdef MACULA_WITH_BENCH

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <tuple>

#include "bench/thesis.hpp"
#include "host/app/bench_options.hpp"
#include "host/app/render_options.hpp"

namespace macula::app {
namespace {

using bench::ThesisRow;

struct Options {
    bench::ThesisOptions thesis;
    std::string lights, size = "1920x1080";
    bool json = false;
};

void add_options(CLI::App& command, Options& options) {
    bench::ThesisOptions& t = options.thesis;
    add_device_option(command, t.device);
    const auto names = [&](const char* option, std::vector<std::string>& values,
                           const char* meaning) {
        command.add_option(option, values, meaning)->delimiter(',');
    };
    const auto number = [&](const char* option, std::uint32_t& value, const char* meaning) {
        command.add_option(option, value, meaning)->capture_default_str();
    };
    names("--views", t.views,
          "\"sponza central\", \"sponza overview\", \"sponza plant\", \"cornell box\", \"temple "
          "statue\", \"temple chamber\", separated by commas (default: all)");
    names("--modes", t.modes,
          "full, logpolar, logpolar+upscale, logpolar+taa+upscale, full+upscale, weier+upscale, "
          "separated by commas (default: all)");
    command.add_option("--scene-path", t.scene_path,
                       "Folder of sponza_crytek/; may be repeated; those of MACULA_SCENE_PATH and "
                       "../shared/scenes follow. Without it the views are of atrium");
    command.add_option("--lights", options.lights, "point, area, ao or soft (default: soft)");
    command.add_option("--size", options.size, "WIDTHxHEIGHT in pixels")->capture_default_str();
    number("--light-samples", t.light_samples, "Shadow rays for each light");
    number("--warm-up", t.warm_up, "Frames of the still view that do not count");
    number("--frames", t.frames, "Measured frames of the still view");
    number("--orbit", t.orbit, "Frames of the moving view, judged for flicker; 0: none");
    number("--reference-spp", t.reference_spp, "Samples a pixel of the still view's reference");
    number("--orbit-spp", t.orbit_spp, "Samples a pixel of the moving view's references");
    number("--seed", t.seed, "Of all that is random");
    command.add_flag("--sweep", t.sweep, "Other radii of the foveal disk, too: figure 5.2");
    command.add_option("--resume", t.resume,
                       "File of JSON lines: rows in it are not measured again, new ones are added");
    command.add_flag("--json", options.json, "One JSON line for each row");
}

int run(const Options& options) {
    bench::ThesisOptions thesis = options.thesis;
    if (!options.lights.empty())
        thesis.lights = parse_lights({options.lights}).front();
    std::tie(thesis.width, thesis.height) = parse_size(options.size);
    if (thesis.width == 0)
        throw std::invalid_argument("--size: which?");
    thesis.bvh_cache = bvh_cache_folder();
    bench::ThesisProgress progress;
    progress.note = progress_line();
    progress.row = [&](const ThesisRow& row, bool) {
        fmt::print("{}", options.json ? json_line(row) + "\n" : bench::thesis_line(row));
        std::fflush(stdout);
    };
    if (!options.json)
        fmt::print("{}", bench::thesis_heading());
    const auto rows = run_thesis(thesis, progress);
    if (!options.json)
        fmt::print("{}", bench::thesis_summary(rows));
    return 0;
}

} // namespace

Run add_bench_thesis(CLI::App& command) {
    auto options = std::make_shared<Options>();
    add_options(command, *options);
    return [options] { return run(*options); };
}

} // namespace macula::app

#endif
