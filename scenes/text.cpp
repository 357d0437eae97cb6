#include "scenes/text.hpp"

#include <algorithm>

namespace macula::scene {
namespace {

constexpr std::string_view kBlank = " \t\r";

// Removes leading digits and says how many there were.
std::size_t skip_digits(std::string_view& text) {
    std::size_t count = 0;
    while (count < text.size() && text[count] >= '0' && text[count] <= '9')
        ++count;
    text.remove_prefix(count);
    return count;
}

void skip_sign(std::string_view& text) {
    if (!text.empty() && (text.front() == '+' || text.front() == '-'))
        text.remove_prefix(1);
}

} // namespace

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos)
        return {};
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::vector<std::string_view> words(std::string_view line) {
    std::vector<std::string_view> result;
    for (std::size_t at = line.find_first_not_of(kBlank); at != std::string_view::npos;) {
        const std::size_t end = std::min(line.find_first_of(kBlank, at), line.size());
        result.push_back(line.substr(at, end - at));
        at = line.find_first_not_of(kBlank, end);
    }
    return result;
}

bool is_number(std::string_view word) {
    skip_sign(word);
    std::size_t digits = skip_digits(word);
    if (!word.empty() && word.front() == '.') {
        word.remove_prefix(1);
        digits += skip_digits(word);
    }
    if (digits == 0)
        return false;
    if (!word.empty() && (word.front() == 'e' || word.front() == 'E')) {
        word.remove_prefix(1);
        skip_sign(word);
        if (skip_digits(word) == 0)
            return false;
    }
    return word.empty();
}

std::size_t line_number(std::string_view text, std::size_t offset) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

} // namespace macula::scene
