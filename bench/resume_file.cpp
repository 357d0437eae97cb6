#include "bench/resume_file.hpp"

#include <fstream>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>

namespace macula::bench {
namespace {

auto key(const FoveationRow& r) {
    return std::tie(r.scene, r.lights, r.frc, r.width, r.height, r.frames, r.segments, r.warm_up,
                    r.gaze, r.device);
}

} // namespace

ResumeFile::ResumeFile(std::filesystem::path path) : path_(std::move(path)) {
    if (path_.empty() || !std::filesystem::exists(path_))
        return;
    std::ifstream file(path_, std::ios::binary);
    std::uintmax_t whole = 0; // bytes of complete lines
    std::size_t number = 0;
    for (std::string line; std::getline(file, line) && !file.eof();) {
        ++number;
        whole += line.size() + 1;
        if (line.empty())
            continue;
        try {
            rows_.push_back(parse_row(line));
        } catch (const std::invalid_argument& error) {
            throw std::runtime_error(
                fmt::format("{}, line {}: {}", path_.string(), number, error.what()));
        }
    }
    if (!file.eof())
        throw std::runtime_error(fmt::format("reading '{}' failed", path_.string()));
    file.close();
    std::filesystem::resize_file(path_, whole);
}

const FoveationRow* ResumeFile::find(const FoveationRow& wanted) const {
    for (const FoveationRow& row : rows_) {
        if (key(row) == key(wanted))
            return &row;
    }
    return nullptr;
}

void ResumeFile::add(const std::string& line) const {
    if (path_.empty())
        return;
    std::ofstream file(path_, std::ios::binary | std::ios::app);
    file << line << '\n';
    file.close();
    if (!file)
        throw std::runtime_error(fmt::format("writing '{}' failed", path_.string()));
}

} // namespace macula::bench
