/// `macula bench rrm`.
#pragma once

#include "host/app/command.hpp"

namespace macula::app {

Run add_bench_rrm(CLI::App& command);

} // namespace macula::app
