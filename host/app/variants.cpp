/// `macula variants`: the traversal variants, and which of them a device uses for which rays.
#include "host/app/variants.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <memory>

#include "host/app/command.hpp"
#include "host/cl/device.hpp"
#include "host/stage/trace.hpp"

namespace macula::app {
namespace {

struct Options {
    std::string device;
    bool names = false;
};

// The device's choices; warnings of its tuning file are printed.
stage::VariantTable choices_of(const compute::Device& device) {
    std::vector<std::string> warnings;
    stage::VariantTable table = stage::choose_variants(device, {}, &warnings);
    for (const std::string& warning : warnings)
        fmt::print(stderr, "macula: warning: {}\n", warning);
    return table;
}

int run(const Options& options) {
    if (options.names) {
        for (const kernel::Variant& variant : kernel::variants())
            fmt::print("{}\n", variant.name);
        return 0;
    }
    print_variants(compute::open(options.device));
    return 0;
}

Run add(CLI::App& command) {
    auto options = std::make_shared<Options>();
    add_device_option(command, options->device);
    command.add_flag("--names", options->names, "Names alone, one a line, the reference last");
    return [options] { return run(*options); };
}

const Command command("variants", "List the traversal variants and what a device uses", add);

} // namespace

void print_variants(const compute::Device& device) {
    const stage::VariantTable chosen = choices_of(device);
    fmt::print("{}", kernel::list_variants(kernel::traits_of(device), chosen));
}

void print_tuning_warnings(const compute::Device& device) {
    choices_of(device);
}

} // namespace macula::app
