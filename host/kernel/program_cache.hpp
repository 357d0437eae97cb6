/// Built programs on disk, so that a second start does not compile.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace macula::kernel {

/// One file for each program: a header, the key's text, the driver's binary and a checksum. A file
/// that is truncated, altered or of another key counts as absent. Failures to write are ignored:
/// the cache only saves time.
class ProgramCache {
  public:
    /// `folder` is made at the first store; empty: nothing is cached.
    explicit ProgramCache(std::filesystem::path folder);

    /// $MACULA_CACHE_DIR, or macula in $XDG_CACHE_HOME or ~/.cache; empty when none is set.
    static std::filesystem::path default_folder();

    /// `key` is everything that the binary depends on, in full.
    std::optional<std::vector<std::byte>> load(const std::string& key) const;
    /// Written to a temporary file, then renamed.
    void store(const std::string& key, std::span<const std::byte> binary) const;

    /// The file that holds `key`.
    std::filesystem::path path_of(const std::string& key) const;

  private:
    std::filesystem::path folder_;
};

} // namespace macula::kernel
