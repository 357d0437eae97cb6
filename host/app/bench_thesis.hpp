/// `macula bench thesis`.
#pragma once

#include "host/app/command.hpp"

namespace macula::app {

Run add_bench_thesis(CLI::App& command);

} // namespace macula::app
