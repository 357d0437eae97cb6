#include "scenes/gaze/csv.hpp"

#include <charconv>
#include <cmath>

#include "scenes/text.hpp"

namespace macula::scene {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

// Takes the first cell off the line; false when that was the last one.
bool take_cell(std::string_view& line, char separator, std::string_view& cell) {
    std::size_t from = 0;
    if (!line.empty() && line.front() == '"') {
        const std::size_t quote = line.find('"', 1);
        from = quote == std::string_view::npos ? 0 : quote;
    }
    const std::size_t end = line.find(separator, from);
    cell = line.substr(0, end);
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
        cell = cell.substr(1, cell.size() - 2);
    // Blanks around a cell mean nothing; with a tab as separator they are all that trimmed() takes.
    cell = trimmed(cell);
    if (end == std::string_view::npos)
        return false;
    line.remove_prefix(end + 1);
    return true;
}

template <typename T>
bool parse(std::string_view text, T& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
}

} // namespace

char separator_of(std::string_view text) {
    const std::string_view first = text.substr(0, text.find('\n'));
    for (const char separator : {'\t', ';'})
        if (first.find(separator) != std::string_view::npos)
            return separator;
    return ',';
}

CsvTable::CsvTable(std::string text, std::string name, char separator, Header header)
    : text_(std::move(text)), name_(std::move(name)), separator_(separator) {
    std::string_view rest = text_;
    if (rest.starts_with(kByteOrderMark))
        rest.remove_prefix(kByteOrderMark.size());
    bool titles = header == Header::present;
    for_each_line(rest, [&](std::string_view line, std::size_t number) {
        if (!line.empty() && line.back() == '\r')
            line.remove_suffix(1);
        if (line.find_first_not_of(" \t") == std::string_view::npos)
            return;
        add_line(line, number);
        if (!titles)
            return;
        header_.swap(cells_);
        lines_.clear();
        titles = false;
    });
    if (columns_ == 0)
        throw SceneError(name_ + ": it is empty");
}

void CsvTable::add_line(std::string_view line, std::size_t number) {
    std::size_t count = 0;
    for (bool more = true; more; ++count) {
        std::string_view cell;
        more = take_cell(line, separator_, cell);
        cells_.push_back(cell);
    }
    if (columns_ == 0)
        columns_ = count;
    lines_.push_back(number);
    if (count != columns_)
        fail(lines_.size() - 1, std::to_string(count) + " values where the first line has " +
                                    std::to_string(columns_));
}

std::optional<std::size_t> CsvTable::find(std::string_view name) const {
    for (std::size_t i = 0; i < header_.size(); ++i) {
        if (header_[i] == name)
            return i;
        const std::string_view rest = header_[i].starts_with(name)
                                          ? trimmed(header_[i].substr(name.size()))
                                          : std::string_view();
        if (!rest.empty() && (rest.front() == '[' || rest.front() == '('))
            return i;
    }
    return std::nullopt;
}

std::size_t CsvTable::column(std::string_view name) const {
    const std::optional<std::size_t> found = find(name);
    if (!found)
        throw SceneError(name_ + ":1: there is no column '" + std::string(name) + "'");
    return *found;
}

std::string CsvTable::title_or_number(std::size_t column) const {
    if (header_.empty())
        return std::to_string(column + 1);
    std::string title("'");
    title.append(header_[column]);
    return title + '\'';
}

double CsvTable::number(std::size_t row, std::size_t column) const {
    double value = 0.0;
    bool read = parse(text(row, column), value);
    if (!read && separator_ != ',') {
        std::string point(text(row, column));
        if (const std::size_t comma = point.find(','); comma != std::string::npos) {
            point[comma] = '.';
            read = parse(std::string_view(point), value);
        }
    }
    if (!read || !std::isfinite(value))
        fail(row, "column " + title_or_number(column) + ": \"" + std::string(text(row, column)) +
                      "\" is no finite number");
    return value;
}

std::int64_t CsvTable::integer(std::size_t row, std::size_t column) const {
    std::int64_t value = 0;
    if (!parse(text(row, column), value))
        fail(row, "column " + title_or_number(column) + ": \"" + std::string(text(row, column)) +
                      "\" is no whole number of 64 bits");
    return value;
}

std::optional<double> CsvTable::number_if_any(std::size_t row, std::size_t column) const {
    const std::string_view cell = text(row, column);
    if (cell.empty() || cell == "nan" || cell == "NaN" || cell == "NA")
        return std::nullopt;
    return number(row, column);
}

void CsvTable::fail(std::size_t row, const std::string& what) const {
    throw SceneError(name_ + ":" + std::to_string(lines_.at(row)) + ": " + what);
}

} // namespace macula::scene
