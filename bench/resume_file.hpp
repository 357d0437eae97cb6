// Rows of a benchmark in a file of JSON lines, so that an interrupted run goes on where it was.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/foveation.hpp"

namespace macula::bench {

class ResumeFile {
  public:
    // Reads the rows that are there; a last line without an end, which an interruption left, is cut
    // off. An empty path keeps nothing. Throws std::runtime_error that names file and line.
    explicit ResumeFile(std::filesystem::path path);

    // The row of the same scene, lights, region, size, frames, segments, warm-up, gaze and device.
    const FoveationRow* find(const FoveationRow& wanted) const;
    void add(const std::string& line) const;

  private:
    std::filesystem::path path_;
    std::vector<FoveationRow> rows_;
};

} // namespace macula::bench
