/// The options of methods that gather samples over frames, for the commands that render.
#pragma once

#include "host/method/method.hpp"

namespace CLI {
class App;
}

namespace macula::app {

void add_temporal_options(CLI::App& command, method::TemporalOptions& options);

} // namespace macula::app
