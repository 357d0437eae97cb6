// Reading scene files from disk, plain or compressed, with a limit on the bytes they unpack to.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace macula::scene {

// More than any scene that a 31-bit triangle id can hold; a guard against compressed bombs.
inline constexpr std::uint64_t kDefaultMaxInputBytes = std::uint64_t{4} << 30;

enum class Compression : std::uint8_t { none, gzip, zstd };

// By the file's last extension: .gz, .zst; anything else is `none`.
Compression compression_of(const std::filesystem::path& path);

// `path` without a trailing .gz or .zst.
std::filesystem::path without_compression(const std::filesystem::path& path);

// Unpacks a whole file's bytes. Throws SceneError, its message starting with `name`, when the data
// are damaged, end early, or unpack to more than `max_bytes`.
std::string decompress(std::string_view data, Compression compression, std::uint64_t max_bytes,
                       const std::string& name);

// The unpacked bytes of a regular file. Throws SceneError when there is no such file, it is a
// directory or a device, cannot be read, or exceeds `max_bytes` (packed or unpacked).
std::string read_file(const std::filesystem::path& path,
                      std::uint64_t max_bytes = kDefaultMaxInputBytes);

// `reference` as a path below `folder`, or an empty path when it leads out of it: absolute paths,
// drive letters and `..` beyond the folder. Backslashes count as slashes.
std::filesystem::path path_below(const std::filesystem::path& folder, std::string reference);

// The same, but where no such file exists the first one, in alphabetical order, whose name differs
// in the case of letters only: what exporters on other systems write.
std::filesystem::path existing_path_below(const std::filesystem::path& folder,
                                          const std::string& reference);

} // namespace macula::scene
