/// What `macula compare` prints. docs/metrics.md describes the JSON.
#pragma once

#include <string>

#include "host/app/compare_run.hpp"

namespace macula::app {

/// One line of JSON.
std::string compare_json(const Compared& result, const CompareOptions& options);

/// A few lines for people.
std::string compare_text(const Compared& result, const CompareOptions& options);

} // namespace macula::app
