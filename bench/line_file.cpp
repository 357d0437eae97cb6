#include "bench/line_file.hpp"

#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

namespace macula::bench {

LineFile::LineFile(std::filesystem::path path, const std::function<void(const std::string&)>& parse)
    : path_(std::move(path)) {
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
            parse(line);
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

void LineFile::add(const std::string& line) const {
    if (path_.empty())
        return;
    std::ofstream file(path_, std::ios::binary | std::ios::app);
    file << line << '\n';
    file.close();
    if (!file)
        throw std::runtime_error(fmt::format("writing '{}' failed", path_.string()));
}

} // namespace macula::bench
