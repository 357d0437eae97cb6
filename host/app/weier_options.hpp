/// The options of the methods weier (docs/methods/weier.md) and lowres.
#pragma once

#include <string>

#include "host/stage/foveated.hpp"

namespace CLI {
class App;
}

namespace macula::app {

struct WeierOptions {
    std::string frc = "medium", support; // WxH; empty: as in the paper
    stage::WeierOptions engine;          // but for what has a member here
    std::string first_frame = "full";    // or "sparse"
    std::string new_parts = "sample";    // or "fill"
    bool no_post = false, no_catch_up = false;
    float lowres_scale = 0.46f; // 0..1; by default about as many samples as the medium region

    void add_to(CLI::App& command);
};

/// small, medium, large or full (section 4.2.1), or R0,R1,PMIN in degrees. Sets the region of
/// `options`. Throws std::invalid_argument.
void parse_frc(const std::string& text, stage::WeierOptions& options);

/// Throws std::invalid_argument that names the option.
stage::WeierOptions engine_options(const WeierOptions& options);

} // namespace macula::app
