/// The options of method weier (docs/methods/weier.md).
#pragma once

#include <string>

#include "host/stage/foveated.hpp"

namespace CLI {
class App;
}

namespace macula::app {

struct WeierOptions {
    std::string frc = "medium", support; // WxH; empty: as in the paper
    stage::WeierOptions engine;          // but for the two above
    bool no_post = false;

    void add_to(CLI::App& command);
};

/// small, medium, large or full (section 4.2.1), or R0,R1,PMIN in degrees. Sets the region of
/// `options`. Throws std::invalid_argument.
void parse_frc(const std::string& text, stage::WeierOptions& options);

/// Throws std::invalid_argument that names the option.
stage::WeierOptions engine_options(const WeierOptions& options);

} // namespace macula::app
