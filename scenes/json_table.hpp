// JSON objects as TOML tables, so that one reader serves both.
#pragma once

#include <string>

#include <toml++/toml.h>

namespace macula::scene {

// Throws SceneError with line and column for text that is no JSON, and for a JSON value that TOML
// cannot hold: anything but an object at the top, or integers beyond 64 bits. Null is left out.
toml::table json_table(const std::string& text, const std::string& name);

} // namespace macula::scene
