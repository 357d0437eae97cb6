#include "host/app/command.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <cstdio>
#include <exception>
#include <utility>
#include <vector>

namespace {

constexpr int kFailure = 1;
constexpr int kWrongUsage = 2;

int run(int argc, char** argv) {
    CLI::App app("Macula, a portable foveated ray tracer", "macula");
    app.set_version_flag("--version", "macula " MACULA_VERSION);
    app.require_subcommand(1);
    std::vector<std::pair<CLI::App*, macula::app::Run>> added;
    for (const macula::app::Command& command : macula::app::commands()) {
        CLI::App* sub = app.add_subcommand(command.name, command.summary);
        added.emplace_back(sub, command.add(*sub));
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0)
            return app.exit(e);
        std::fprintf(stderr, "macula: %s\nRun `macula --help` or `macula COMMAND --help`.\n",
                     e.what());
        return kWrongUsage;
    }
    for (const auto& [sub, execute] : added)
        if (sub->parsed())
            return execute();
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "macula: %s\n", e.what());
        return kFailure;
    }
}
