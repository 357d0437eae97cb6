/// `macula bench`: the traversal variants beside Embree, and the foveated benchmarks.
#include "host/app/command.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <memory>
#include <stdexcept>

#ifdef MACULA_WITH_BENCH

#include "bench/report.hpp"
#include "bench/traversal.hpp"
#include "host/app/bench_foveation.hpp"
#include "host/app/bench_quality.hpp"
#include "host/app/bench_rrm.hpp"
#include "host/app/bench_thesis.hpp"

#include <unistd.h>

namespace {

using macula::bench::TraversalOptions;
using macula::bench::TraversalProgress;
using macula::bench::TraversalReport;

struct Options {
    TraversalOptions traversal;
    std::vector<std::string> classes;
    bool json = false;
};

void parse_classes(Options& options) {
    for (const std::string& name : options.classes) {
        const auto parsed = macula::kernel::parse_ray_class(name);
        if (!parsed)
            throw std::invalid_argument("--rays: no ray class is called \"" + name +
                                        "\" (primary, shadow, ao, diffuse, random, sparse)");
        options.traversal.classes.push_back(*parsed);
    }
}

void print_json(const TraversalReport& report, std::size_t first_new) {
    for (std::size_t i = first_new; i < report.records.size(); ++i) {
        const auto& record = report.records[i];
        if (record.skipped.empty())
            fmt::print("{}\n", json_line(report, record));
        else
            fmt::print(stderr, "{}, {}, {}: left out: {}\n", record.scene,
                       macula::kernel::name(record.rays), record.variant, record.skipped);
    }
    std::fflush(stdout);
}

void print_table(const TraversalReport& report, std::size_t first_new) {
    if (first_new == 0)
        fmt::print("{}", heading(report));
    fmt::print("{}", macula::bench::table(std::span(report.records).subspan(first_new)));
    std::fflush(stdout);
}

int run(Options options) {
    parse_classes(options);
    TraversalProgress progress;
    const bool terminal = isatty(STDERR_FILENO) != 0;
    progress.note = [terminal](const std::string& line) {
        if (terminal)
            fmt::print(stderr, "\r\033[K{}\r", line);
    };
    progress.records = options.json ? print_json : print_table;
    const TraversalReport report = run_traversal(options.traversal, progress);
    if (!options.json)
        fmt::print("{}", summary(report));
    return 0;
}

macula::app::Run add_traversal(CLI::App& command) {
    auto options = std::make_shared<Options>();
    TraversalOptions& t = options->traversal;
    macula::app::add_device_option(command, t.device);
    command.add_option("--scene", t.scenes,
                       "Built-in scene, file, or sponza_crytek or minecraft_overworld; may be "
                       "repeated (default: atrium, voxel_city and those two where found)");
    command.add_option("--scene-path", t.scene_path,
                       "Folder of sponza_crytek/ and minecraft_overworld/; may be repeated; those "
                       "of MACULA_SCENE_PATH and ../shared/scenes follow");
    command.add_option("--rays", options->classes,
                       "Ray class: primary, shadow, ao, diffuse, random, sparse; may be repeated "
                       "(default: all)");
    command.add_option("--variant", t.variants,
                       "Variant; may be repeated (default: all that apply)");
    command.add_option("--rounds", t.rounds, "Rounds of which the median counts")
        ->capture_default_str();
    command
        .add_option("--size", t.rays.size,
                    "Primary rays are SIZE x SIZE; the other classes scale with it")
        ->capture_default_str();
    command.add_option("--seed", t.rays.seed, "Seed of the rays")->capture_default_str();
    command
        .add_option("--time-limit", t.limit_seconds,
                    "Seconds that one variant may take on one ray class, all rounds together; "
                    "slower ones are left out")
        ->capture_default_str();
    command.add_flag("--json", options->json,
                     "One JSON line for each scene, ray class and variant");
    return [options] { return run(*options); };
}

macula::app::Run add(CLI::App& command) {
    CLI::App* traversal = command.add_subcommand(
        "traversal", "Traversal variants and Embree on the same rays and cores");
    CLI::App* table1 = command.add_subcommand(
        "table1", "Full and foveated frames along fly-throughs: table 1 of Weier et al. 2016");
    CLI::App* figure5 =
        command.add_subcommand("figure5", "The same for four foveal regions: their figure 5");
    CLI::App* quality = command.add_subcommand(
        "quality", "Quality and time of full, weier and lowres against converged references");
    CLI::App* thesis = command.add_subcommand(
        "thesis", "Views and modes of Mrad 2022, chapter 5: time, FLIP and flicker");
    CLI::App* rrm = command.add_subcommand(
        "rrm", "Refresh rate modulation beside full frames: figures 9 to 11 of Smith et al. 2014");
    command.require_subcommand(1);
    const auto run_traversal = add_traversal(*traversal);
    const auto run_table1 = macula::app::add_bench_table1(*table1);
    const auto run_figure5 = macula::app::add_bench_figure5(*figure5);
    const auto run_quality = macula::app::add_bench_quality(*quality);
    const auto run_thesis = macula::app::add_bench_thesis(*thesis);
    const auto run_rrm = macula::app::add_bench_rrm(*rrm);
    return [=] {
        if (table1->parsed())
            return run_table1();
        if (quality->parsed())
            return run_quality();
        if (rrm->parsed())
            return run_rrm();
        if (thesis->parsed())
            return run_thesis();
        return figure5->parsed() ? run_figure5() : run_traversal();
    };
}

} // namespace

#else

namespace {
constexpr auto add = macula::app::add_without_benchmarks;
} // namespace

#endif

namespace {
const macula::app::Command command("bench", "Measure against Embree and against full frames", add);
} // namespace
