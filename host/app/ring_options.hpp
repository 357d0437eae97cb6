/// The options of the method lowres_rings (docs/methods/lowres_rings.md).
#pragma once

#include "host/stage/rings.hpp"

namespace CLI {
class App;
}

namespace macula::app {

void add_ring_options(CLI::App& command, stage::RingOptions& options);

} // namespace macula::app
