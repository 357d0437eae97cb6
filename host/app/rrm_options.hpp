/// The options of the method rrm (docs/methods/rrm.md).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/stage/rrm.hpp"

namespace CLI {
class App;
}

namespace macula::app {

struct RrmOptions {
    stage::RrmOptions engine;          // but for what has a member here
    std::string group = "3x4";         // blocks: WxH, or N alone
    std::string order = "horizontal";  // see stage::RefreshOrder
    std::string block = "2x2";         // pixels, or "4x1"
    std::string groups = "interlaced"; // or "apart"
    std::string first_frame = "full";  // or "turns"
    std::string cut = "full";          // or "stale"
    std::string shape = "rectangle";   // or "disk"
    std::vector<std::string> rings;    // DEGREES:FRAMES each

    void add_to(CLI::App& command);
};

/// Throws std::invalid_argument that names the option.
stage::RrmOptions engine_options(const RrmOptions& options);

} // namespace macula::app
