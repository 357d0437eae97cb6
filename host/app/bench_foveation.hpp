/// `macula bench table1` and `macula bench figure5`.
#pragma once

#include "host/app/command.hpp"

namespace macula::app {

Run add_bench_table1(CLI::App& command);
Run add_bench_figure5(CLI::App& command);

} // namespace macula::app
