// Files of JSON lines, one finished case each.
#pragma once

#include <filesystem>
#include <vector>

#include "host/report/quality_case.hpp"

namespace macula::report {

// All cases of a file. Throws std::runtime_error that names file and line: for a line that is no
// case, for a last line without its end (an interrupted run leaves one; `macula bench quality
// --resume` mends it), and for a file that cannot be read or has no line.
std::vector<QualityCase> read_results(const std::filesystem::path& file);

} // namespace macula::report
