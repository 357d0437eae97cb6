/// Pictures made small for documents.
#pragma once

#include <filesystem>
#include <string>

namespace macula::output {

/// The content of a JPEG file (4:4:4, quality 1..100) with the first three channels of an 8-bit
/// picture file. Throws std::runtime_error that names the file and the cause, std::invalid_argument
/// for a quality out of range.
std::string as_jpeg(const std::filesystem::path& picture, int quality);

} // namespace macula::output
