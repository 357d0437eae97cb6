/// The subcommands of `macula`: one file each, which registers itself, so that adding a file adds a
/// command:
///
///     namespace {
///     struct Options { std::string device; bool json = false; };
///
///     macula::app::Run add(CLI::App& command) {
///         auto options = std::make_shared<Options>();
///         macula::app::add_device_option(command, options->device);
///         command.add_flag("--json", options->json, "One JSON document");
///         return [options] { return run(*options); };   // the exit code: 0 or 1
///     }
///     const macula::app::Command command("devices", "List the OpenCL devices", add);
///     } // namespace
///
/// An exception that leaves `run` is printed as "macula: <message>" and ends the program with 1;
/// wrong usage ends it with 2.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace macula::app {

/// Executes a command whose options were parsed; returns the exit code.
using Run = std::function<int()>;

class Command {
  public:
    using Add = Run (*)(CLI::App& command);

    /// Registers a command for the program's life; `add` declares its options.
    Command(const char* name, const char* summary, Add add);

    const char* name;
    const char* summary;
    Add add;
};

/// What stands for a command that the program was built without: running it is an error.
Run add_without_benchmarks(CLI::App& command);

/// All commands, sorted by name.
std::vector<Command> commands();

/// `--device SELECTOR`: an index, a part of a name, cpu or gpu; empty when it is not given.
void add_device_option(CLI::App& command, std::string& selector);

} // namespace macula::app
