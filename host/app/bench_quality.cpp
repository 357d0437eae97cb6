#include "host/app/bench_quality.hpp"

#ifdef MACULA_WITH_BENCH

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <tuple>

#include "bench/quality.hpp"
#include "host/app/bench_options.hpp"
#include "host/app/render_options.hpp"
#include "host/kernel/program_cache.hpp"

namespace macula::app {
namespace {

using bench::QualityOptions;
using report::QualityCase;

struct Options {
    QualityOptions quality;
    std::vector<std::string> lights, regions, changes;
    std::string size;
    std::filesystem::path out, resume;
    bool json = false, no_reference_cache = false;
};

void add_what(CLI::App& command, Options& options) {
    QualityOptions& q = options.quality;
    add_device_option(command, q.device);
    command
        .add_option("--scenes,--scene", q.scenes,
                    "Built-in scenes, files, sibenik or sponza_crytek, separated by commas")
        ->delimiter(',')
        ->required();
    command.add_option("--scene-path", q.scene_path,
                       "Folder of sibenik/ and sponza_crytek/; may be repeated; those of "
                       "MACULA_SCENE_PATH and ../shared/scenes follow");
    command
        .add_option("--lights", options.lights,
                    "point, area, soft, ao, separated by commas (default: area)")
        ->delimiter(',');
    command
        .add_option("--methods", q.methods,
                    "Names of `macula explain`, separated by commas (default: full, weier, lowres)")
        ->delimiter(',');
    command.add_option("--frc", options.regions,
                       "Foveal regions of weier, and of lowres beside it: small, medium, large, "
                       "full or R0,R1,PMIN; may be repeated (default: medium)");
    command
        .add_option("--spp", q.spp, "Samples per pixel of full, separated by commas (default 1)")
        ->delimiter(',');
    command.add_option(
        "--parameters", options.changes,
        "Of weier, as KEY=VALUE,... with eps-depth, eps-lum, eps-edge, eps-stretch, "
        "eps-merge, k-min, k-max, resampled-worth, t-max of render; may be repeated, \"\": none");
    command
        .add_option("--equal", q.equal,
                    "What lowres has in common with weier: samples, time (default: each)")
        ->delimiter(',');
}

void add_view(CLI::App& command, Options& options) {
    QualityOptions& q = options.quality;
    command.add_option("--display", q.display, "Field of view and size")->capture_default_str();
    command.add_option("--size", options.size, "WIDTHxHEIGHT in pixels (default: the display's)");
    command.add_option("--trace", q.trace,
                       "Recording of gaze and head, as `macula gaze import` reads (default: one of "
                       "../shared/traces where it is found)");
    command.add_option("--gaze", q.gaze,
                       "As --gaze of render, instead of the recording's (without any: synthetic)");
    command.add_option("--tracker", q.tracker, "As --tracker of render");
    command.add_option("--head", q.head,
                       "FILE.csv as --head of render, or scene: the path alone (default: the "
                       "recording's)");
    command.add_option("--frames", q.frames, "Measured frames")->capture_default_str();
    command.add_option("--segments", q.segments, "Stretches of the path that the frames lie in")
        ->capture_default_str();
    command.add_option("--warm-up", q.warm_up, "Frames before each stretch that do not count")
        ->capture_default_str();
    command.add_option("--seed", q.seed, "Of all random numbers")->capture_default_str();
}

void add_results(CLI::App& command, Options& options) {
    QualityOptions& q = options.quality;
    command.add_option("--reference-spp", q.reference_spp, "Samples per pixel of the references")
        ->capture_default_str();
    command.add_flag("--no-reference-cache", options.no_reference_cache,
                     "Neither read nor keep references on disk");
    command.add_option("--pictures", q.pictures, "Frames of each case with pictures")
        ->capture_default_str();
    CLI::Option* out = command.add_option(
        "--out", options.out, "Folder for results.jsonl, anew, with pictures and a summary");
    command
        .add_option("--resume", options.resume,
                    "File of JSON lines: cases in it are not run again, new ones are added; "
                    "pictures and summary go beside it")
        ->excludes(out);
    command.add_flag("--json", options.json, "Print one JSON line for each case");
}

/// Throws std::invalid_argument.
QualityOptions parse(const Options& options) {
    QualityOptions quality = options.quality;
    quality.lights = parse_lights(options.lights);
    const std::vector<std::string> medium = {"medium"}, none = {""};
    for (const std::string& region : options.regions.empty() ? medium : options.regions) {
        for (const std::string& changes : options.changes.empty() ? none : options.changes) {
            bench::QualityWeier weier{region, changes, {}};
            parse_frc(region, weier.options);
            bench::parse_weier_changes(changes, weier.options);
            quality.weier.push_back(weier);
        }
    }
    std::tie(quality.width, quality.height) = parse_size(options.size);
    quality.bvh_cache = bvh_cache_folder();
    const std::filesystem::path cache = kernel::ProgramCache::default_folder();
    if (!options.no_reference_cache && !cache.empty())
        quality.reference_cache = cache / "references";
    quality.results = options.out.empty() ? options.resume : options.out / "results.jsonl";
    return quality;
}

/// The folder is there afterwards; without --resume the file is not.
void prepare(const Options& options, const QualityOptions& quality) {
    if (quality.results.empty())
        return;
    if (quality.results.has_parent_path())
        std::filesystem::create_directories(quality.results.parent_path());
    if (!options.out.empty())
        std::filesystem::remove(quality.results);
}

/// RESULTS.summary.json, under another name first.
void write_summary(const std::filesystem::path& results, const std::vector<QualityCase>& cases) {
    if (results.empty())
        return;
    std::filesystem::path path = results;
    path.replace_extension(".summary.json");
    std::filesystem::path part = path;
    part += ".part";
    std::ofstream file(part, std::ios::binary);
    file << bench::google_benchmark(cases);
    file.close();
    if (!file)
        throw std::runtime_error(fmt::format("writing '{}' failed", part.string()));
    std::filesystem::rename(part, path);
}

std::string score(const std::optional<double>& value) {
    return value ? fmt::format("{:.3g}", *value) : "-";
}

void print_case(const QualityCase& c) {
    fmt::print("{:<14} {:<6} {:<22} {:>8.2f} {:>8.3f} {:>8.4f} {:>8.4f} {:>8} {:>7} {:>6.3f} "
               "{:>9} {:>9}\n",
               c.scene, c.lights, c.name, c.time_ms.median,
               c.samples / (static_cast<double>(c.width) * c.height), c.scores.flip.mean,
               c.scores.foveated_flip.mean, score(c.against_full.flip_inside_r0),
               c.scores.psnr ? fmt::format("{:.2f}", *c.scores.psnr) : "inf", c.scores.ssim,
               score(c.scores.flicker_energy), score(c.scores.instability));
}

int run(const Options& options) {
    const QualityOptions quality = parse(options);
    prepare(options, quality);
    bench::QualityProgress progress;
    progress.note = progress_line();
    progress.done = [&](const QualityCase& result, bool) {
        if (options.json)
            fmt::print("{}\n", json_line(result));
        else
            print_case(result);
        std::fflush(stdout);
    };
    if (!options.json)
        fmt::print("{:<14} {:<6} {:<22} {:>8} {:>8} {:>8} {:>8} {:>8} {:>7} {:>6} {:>9} {:>9}\n",
                   "scene", "lights", "case", "ms", "samples", "FLIP", "foveated", "fovea*", "PSNR",
                   "SSIM", "flicker", "instab.");
    write_summary(quality.results, run_quality(quality, progress));
    if (!options.json)
        fmt::print("* FLIP inside r0, against full at one sample a pixel\n");
    return 0;
}

} // namespace

Run add_bench_quality(CLI::App& command) {
    auto options = std::make_shared<Options>();
    add_what(command, *options);
    add_view(command, *options);
    add_results(command, *options);
    return [options] { return run(*options); };
}

} // namespace macula::app

#endif
