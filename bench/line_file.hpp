// A file of JSON lines that grows by whole lines, so that an interrupted run goes on where it was.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace macula::bench {

class LineFile {
  public:
    // Calls `parse` with each line that is there; a last line without an end, which an interruption
    // left, is cut off. An empty path keeps nothing. What `parse` throws as std::invalid_argument
    // becomes a std::runtime_error that names file and line.
    LineFile(std::filesystem::path path, const std::function<void(const std::string&)>& parse);

    // Throws std::runtime_error.
    void add(const std::string& line) const;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

} // namespace macula::bench
