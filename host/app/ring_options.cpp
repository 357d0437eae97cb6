#include "host/app/ring_options.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

namespace macula::app {

void add_ring_options(CLI::App& command, stage::RingOptions& options) {
    constexpr const char* kGroup = "Method lowres_rings";
    command
        .add_option("--ring-edges", options.edges,
                    "Degrees from the gaze to where blocks are 2, 4 and 8 pixels wide")
        ->delimiter(',')
        ->capture_default_str()
        ->group(kGroup);
    command.add_flag("!--no-ring-blur", options.blur, "Show blocks as they are")->group(kGroup);
    command.add_flag("--ring-grid", options.grid, "Draw the blocks' outlines")->group(kGroup);
}

} // namespace macula::app
