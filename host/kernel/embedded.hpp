/// The OpenCL C files under kernels/, embedded into the program by cmake/EmbedFiles.cmake.
#pragma once

#include <span>
#include <string_view>

namespace macula::kernel {

struct EmbeddedFile {
    /// Below kernels/, e.g. "traverse/wide8.cl".
    std::string_view path;
    std::string_view text;
};

/// All files, sorted by path.
std::span<const EmbeddedFile> embedded_files();

} // namespace macula::kernel
