/// The options of the method logpolar (docs/methods/logpolar.md).
#pragma once

#include "host/stage/log_polar.hpp"

namespace CLI {
class App;
}

namespace macula::app {

void add_log_polar_options(CLI::App& command, stage::LogPolarOptions& options);

} // namespace macula::app
