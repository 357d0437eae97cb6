/// `macula tune`: measures the traversal variants on a device and keeps the fastest ones.
#include "host/app/command.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <memory>
#include <stdexcept>

#ifdef MACULA_WITH_BENCH

#include "bench/tuner.hpp"
#include "host/cl/device.hpp"
#include "host/kernel/tuning.hpp"

#include <unistd.h>

namespace {

using macula::bench::TuneClass;

struct Options {
    std::string device;
    bool quick = false;
};

std::string parameters_of(const macula::kernel::Choice& choice) {
    std::string text;
    for (const macula::kernel::Parameter& parameter : choice.variant->parameters)
        text += fmt::format(
            "  {} {}", parameter.name,
            macula::kernel::parameter(*choice.variant, choice.parameters, parameter.name));
    return text;
}

void print(const TuneClass& measured) {
    fmt::print("\n{} rays\n", macula::kernel::name(measured.rays));
    bool first = true;
    for (const auto& candidate : measured.candidates) {
        const char* name = candidate.choice.variant->name;
        if (candidate.skipped.empty())
            fmt::print("  {} {:<26} {:>8.2f} Mrays/s{}\n", first ? '*' : ' ', name,
                       candidate.mrays_per_s, parameters_of(candidate.choice));
        else
            fmt::print("    {:<26} left out: {}\n", name, candidate.skipped);
        first = false;
    }
}

int run(const Options& options) {
    macula::compute::Device device = macula::compute::open(options.device);
    const macula::bench::TuneOptions how =
        options.quick ? macula::bench::TuneOptions::quick() : macula::bench::TuneOptions{};
    fmt::print("device  {}\ndriver  {}\n", device.facts().name, device.facts().driver_version);
    const bool terminal = isatty(STDERR_FILENO) != 0;
    const auto note = [terminal](const std::string& line) {
        if (terminal)
            fmt::print(stderr, "\r\033[K{}\r", line);
    };
    macula::kernel::Tuning tuning = macula::kernel::Tuning::of(device.facts());
    for (const TuneClass& measured : macula::bench::tune(device, how, note)) {
        print(measured);
        if (!measured.candidates.empty() && measured.candidates.front().skipped.empty())
            tuning.choices[measured.rays] = measured.candidates.front().choice;
    }
    const auto folder = macula::kernel::tuning_folder();
    fmt::print("\nstored in {}\n", macula::kernel::store_tuning(folder, tuning).string());
    return 0;
}

macula::app::Run add(CLI::App& command) {
    auto options = std::make_shared<Options>();
    macula::app::add_device_option(command, options->device);
    command.add_flag("--quick", options->quick, "One scene, fewer rays and rounds");
    return [options] { return run(*options); };
}

} // namespace

#else

namespace {
constexpr auto add = macula::app::add_without_benchmarks;
} // namespace

#endif

namespace {
const macula::app::Command command("tune", "Find the fastest traversal variants on a device", add);
} // namespace
