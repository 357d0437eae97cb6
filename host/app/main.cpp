#include "host/app/command.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace {

constexpr int kFailure = 1;
constexpr int kWrongUsage = 2;

/// CLI11 says "a subcommand is required" for an unknown one, too.
std::string usage_problem(const CLI::ParseError& error, int argc, char** argv) {
    const auto all = macula::app::commands();
    const auto is_known = [&](const macula::app::Command& c) {
        return c.name == std::string(argv[1]);
    };
    if (argc < 2 || argv[1][0] == '-' || std::any_of(all.begin(), all.end(), is_known))
        return error.what();
    return "there is no command \"" + std::string(argv[1]) + "\"";
}

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
                     usage_problem(e, argc, argv).c_str());
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
