// Tables of text: values separated by one character, a line for each row.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/error.hpp"

namespace macula::scene {

// Lines end with \n or \r\n; empty ones are skipped, and so is a byte order mark. Every row has as
// many cells as the first. A cell in double quotes may hold the separator. Where that is no comma,
// a number may have a decimal comma. Errors are SceneError, their messages begin with file and
// line.
class CsvTable {
  public:
    enum class Header : std::uint8_t { present, absent };

    CsvTable(std::string text, std::string name, char separator, Header header);

    std::size_t rows() const { return lines_.size(); }
    std::size_t columns() const { return columns_; }
    // The column called `name`, or whose name goes on with a unit in brackets: `t [ms]`, `t (ms)`.
    std::optional<std::size_t> find(std::string_view name) const;
    std::size_t column(std::string_view name) const; // throws where there is none
    std::string_view title(std::size_t column) const { return header_.at(column); }

    std::string_view text(std::size_t row, std::size_t column) const {
        return cells_[row * columns_ + column];
    }
    double number(std::size_t row, std::size_t column) const; // finite
    std::int64_t integer(std::size_t row, std::size_t column) const;
    // Nothing where the cell is empty or not a number (nan).
    std::optional<double> number_if_any(std::size_t row, std::size_t column) const;

    [[noreturn]] void fail(std::size_t row, const std::string& what) const;
    const std::string& name() const { return name_; }

  private:
    void add_line(std::string_view line, std::size_t number);
    std::string title_or_number(std::size_t column) const;

    std::string text_, name_;
    char separator_;
    std::vector<std::string_view> header_, cells_;
    std::size_t columns_ = 0;
    std::vector<std::size_t> lines_; // of each row, in the file
};

// The separator of the first line: a tab, a semicolon or, without either, a comma.
char separator_of(std::string_view text);

} // namespace macula::scene
