/// `macula compare`: how far pictures or sequences are from a reference, to the eye.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <stdexcept>

#include "host/app/command.hpp"
#include "host/app/compare_report.hpp"

namespace {

using namespace macula;

int run(const app::CompareOptions& options) {
    const std::vector<app::FrameList> lists = app::list_frames(options.pictures, options.frames);
    std::optional<app::FrameList> motion;
    if (!options.motion.empty()) {
        if (options.still)
            throw std::invalid_argument("--motion and --still: a still camera has no motion");
        motion = app::list_motion(options.motion, lists.front());
    }
    for (std::size_t test = 1; test < lists.size(); ++test) {
        const app::Compared result =
            app::compare_frames(options, lists.front(), lists[test], motion ? &*motion : nullptr,
                                static_cast<unsigned>(test));
        fmt::print("{}", options.json ? app::compare_json(result, options)
                                      : app::compare_text(result, options));
        std::fflush(stdout);
    }
    return 0;
}

app::Run add(CLI::App& command) {
    auto options = std::make_shared<app::CompareOptions>();
    options->add_to(command);
    return [options] { return run(*options); };
}

const app::Command command("compare", "Score pictures or sequences against a reference", add);

} // namespace
