/// `macula bench quality`.
#pragma once

#include "host/app/command.hpp"

namespace macula::app {

Run add_bench_quality(CLI::App& command);

} // namespace macula::app
