// Rows of a foveated benchmark in a file of JSON lines.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/foveation.hpp"
#include "bench/line_file.hpp"

namespace macula::bench {

class ResumeFile {
  public:
    // As LineFile.
    explicit ResumeFile(std::filesystem::path path);

    // The row of the same scene, lights, region, size, frames, segments, warm-up, gaze and device.
    const FoveationRow* find(const FoveationRow& wanted) const;
    void add(const std::string& line) const { file_.add(line); }

  private:
    std::vector<FoveationRow> rows_; // filled while file_ is made
    LineFile file_;
};

} // namespace macula::bench
