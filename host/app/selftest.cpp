/// `macula selftest`: does this device, with this driver, run Macula correctly?
#include "host/selftest/selftest.hpp"
#include "host/app/command.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <memory>

namespace {

struct Options {
    std::string device;
    bool all = false, quick = false;
};

bool test_device(const std::string& selector, bool quick) {
    const macula::compute::Device device = macula::compute::open(selector);
    macula::kernel::Library library;
    fmt::print("device {}: {} ({})\n", device.facts().index, device.facts().name,
               device.facts().driver_version);
    const bool passed = macula::selftest::run_all(
        device, library, quick, [](const macula::selftest::Outcome& outcome) {
            fmt::print("  {} {}: {}\n", outcome.passed ? "pass" : "FAIL", outcome.check,
                       outcome.detail);
            std::fflush(stdout);
        });
    fmt::print("  {}\n", passed ? "this device runs Macula correctly"
                                : "do not trust pictures or figures made on this device");
    return passed;
}

// Every device that can run Macula at all; the others are named with the reason.
bool test_all(bool quick) {
    const auto devices = macula::compute::enumerate();
    if (devices.empty())
        return test_device("", quick); // throws the message that names the package to install
    bool passed = true;
    for (const auto& facts : devices) {
        if (facts.available && facts.compiler_available && facts.full_profile &&
            (facts.major > 1 || facts.minor >= 2)) {
            passed = test_device(std::to_string(facts.index), quick) && passed;
        } else {
            fmt::print("device {}: {}: skipped (needs an available OpenCL 1.2 full-profile device "
                       "with a compiler)\n",
                       facts.index, facts.name);
        }
    }
    return passed;
}

macula::app::Run add(CLI::App& command) {
    auto options = std::make_shared<Options>();
    macula::app::add_device_option(command, options->device);
    command.add_flag("--all", options->all, "Every device");
    command.add_flag("--quick", options->quick, "Neither traversal nor frames");
    return [options] {
        return (options->all ? test_all(options->quick)
                             : test_device(options->device, options->quick))
                   ? 0
                   : 1;
    };
}

const macula::app::Command command("selftest", "Check that a device runs Macula correctly", add);

} // namespace
