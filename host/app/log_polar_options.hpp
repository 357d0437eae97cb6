/// The options of the methods logpolar and logrect (docs/methods).
#pragma once

#include "host/stage/log_polar.hpp"

namespace CLI {
class App;
}

namespace macula::app {

void add_log_polar_options(CLI::App& command, stage::LogPolarOptions& options);

} // namespace macula::app
