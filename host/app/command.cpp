#include "host/app/command.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <stdexcept>
#include <string_view>

namespace macula::app {
namespace {

/// A function's static: commands register themselves before main, in any order.
std::vector<Command>& registry() {
    static std::vector<Command> all;
    return all;
}

} // namespace

Command::Command(const char* command_name, const char* command_summary, Add command_add)
    : name(command_name), summary(command_summary), add(command_add) {
    registry().push_back(*this);
}

Run add_without_benchmarks(CLI::App& command) {
    command.allow_extras();
    return [name = command.get_name()]() -> int {
        throw std::runtime_error(name + ": built without the benchmarks; configure with "
                                        "-DMACULA_BUILD_BENCH=ON and Embree 3 (libembree-dev) "
                                        "installed");
    };
}

std::vector<Command> commands() {
    std::vector<Command> sorted = registry();
    std::sort(sorted.begin(), sorted.end(), [](const Command& a, const Command& b) {
        return std::string_view(a.name) < std::string_view(b.name);
    });
    return sorted;
}

void add_device_option(CLI::App& command, std::string& selector) {
    command.add_option("--device", selector,
                       "OpenCL device: an index of `macula devices`, a part of a name, cpu or gpu "
                       "(default: MACULA_DEVICE, or else the first GPU, or else the first CPU)");
}

} // namespace macula::app
