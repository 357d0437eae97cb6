// Pictures as text.
#pragma once

#include <string>
#include <string_view>

namespace macula::report {

// RFC 4648, section 4, with padding.
std::string base64(std::string_view bytes);

// "data:image/png;base64,..." of a PNG, JPEG or WebP file's content, told by how it begins. Empty
// for anything else.
std::string data_uri(std::string_view content);

} // namespace macula::report
