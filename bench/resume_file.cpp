#include "bench/resume_file.hpp"

#include <tuple>

namespace macula::bench {
namespace {

auto key(const FoveationRow& r) {
    return std::tie(r.scene, r.lights, r.frc, r.width, r.height, r.frames, r.segments, r.warm_up,
                    r.gaze, r.device);
}

} // namespace

ResumeFile::ResumeFile(std::filesystem::path path)
    : file_(std::move(path),
            [this](const std::string& line) { rows_.push_back(parse_row(line)); }) {}

const FoveationRow* ResumeFile::find(const FoveationRow& wanted) const {
    for (const FoveationRow& row : rows_) {
        if (key(row) == key(wanted))
            return &row;
    }
    return nullptr;
}

} // namespace macula::bench
