// The page's template, style and script, embedded into the program by cmake/EmbedFiles.cmake.
#pragma once

#include <span>
#include <string_view>

namespace macula::report {

struct EmbeddedFile {
    std::string_view path; // "page.html"
    std::string_view text;
};

std::span<const EmbeddedFile> embedded_files();

} // namespace macula::report
