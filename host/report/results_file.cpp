#include "host/report/results_file.hpp"

#include <fstream>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

namespace macula::report {

std::vector<QualityCase> read_results(const std::filesystem::path& file) {
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored))
        throw std::runtime_error(fmt::format(
            "results '{}': a folder; a file of JSON lines was expected", file.string()));
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
        throw std::runtime_error(fmt::format("results '{}': cannot be read", file.string()));
    std::vector<QualityCase> cases;
    std::size_t number = 0;
    const auto fail = [&](const char* what) {
        throw std::runtime_error(
            fmt::format("results '{}', line {}: {}", file.string(), number, what));
    };
    for (std::string line; std::getline(stream, line);) {
        ++number;
        if (stream.eof())
            fail("the line is cut off: it has no end. `macula bench quality --resume` on the file "
                 "removes it and runs its case again");
        if (line.empty())
            continue;
        try {
            cases.push_back(parse_case(line));
        } catch (const std::invalid_argument& error) {
            fail(error.what());
        }
    }
    if (stream.bad())
        throw std::runtime_error(fmt::format("results '{}': reading failed", file.string()));
    if (cases.empty())
        throw std::runtime_error(fmt::format("results '{}': no case in it", file.string()));
    return cases;
}

} // namespace macula::report
