/// What the benchmarks of whole frames take from the command line alike.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "host/frame/lights.hpp"

namespace macula::app {

/// Names of --lights. Throws std::invalid_argument for one that is none.
std::vector<frame::LightMode> parse_lights(const std::vector<std::string>& names);

/// Pixels of --size; 0 and 0 where it is empty: the display's. Throws std::invalid_argument.
std::pair<std::uint32_t, std::uint32_t> parse_size(const std::string& size);

/// Shows a line of progress on the terminal, over the one before; nothing elsewhere.
std::function<void(const std::string& line)> progress_line();

} // namespace macula::app
