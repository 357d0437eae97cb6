// Small helpers for the line-based text formats.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace macula::scene {

// Without blanks, tabs and carriage returns at both ends.
std::string_view trimmed(std::string_view text);

// The words of a line, separated by blanks and tabs.
std::vector<std::string_view> words(std::string_view line);

// True for a decimal number as OBJ and MTL write them: -1, .5, 3.4e-003. `nan` and `inf` are none.
bool is_number(std::string_view word);

// 1 for an offset in the first line. Offsets beyond the text count as its end.
std::size_t line_number(std::string_view text, std::size_t offset);

// Calls visit(line, number) for every line of the text, without its line end, numbered from 1.
template <typename Visit>
void for_each_line(std::string_view text, Visit&& visit) {
    std::size_t number = 1;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        visit(text.substr(0, end), number++);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
}

} // namespace macula::scene
