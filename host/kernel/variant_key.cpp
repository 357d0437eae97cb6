#include "host/kernel/variant_key.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace macula::kernel {
namespace {

constexpr std::array<std::string_view, 4> kReserved{"any_hit", "instances", "masks",
                                                    "correctly_rounded"};

bool is_name(std::string_view name) {
    const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
    const auto is_inner = [&](char c) {
        return is_letter(c) || (c >= '0' && c <= '9') || c == '_';
    };
    return !name.empty() && is_letter(name.front()) &&
           std::all_of(name.begin(), name.end(), is_inner);
}

} // namespace

VariantKey::VariantKey(std::string program) : program_(std::move(program)) {}

VariantKey& VariantKey::parameter(std::string_view name, std::int64_t value) {
    if (!is_name(name))
        throw std::invalid_argument("kernel parameter \"" + std::string(name) + "\" of " +
                                    program_ + ": a name is lower-case letters, digits and _");
    if (std::find(kReserved.begin(), kReserved.end(), name) != kReserved.end())
        throw std::invalid_argument("kernel parameter \"" + std::string(name) + "\" of " +
                                    program_ + " is set by a function of its own");
    return define(name, value);
}

VariantKey& VariantKey::define(std::string_view name, std::int64_t value) {
    values_.insert_or_assign(std::string(name), value);
    return *this;
}

std::string VariantKey::macro_name(std::string_view parameter) {
    std::string macro = "MACULA_";
    for (const char c : parameter)
        macro += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    return macro;
}

std::string VariantKey::options() const {
    std::string text;
    for (const auto& [name, value] : values_)
        text += (text.empty() ? "-D" : " -D") + macro_name(name) + "=" + std::to_string(value);
    return text;
}

std::string VariantKey::text() const {
    std::string values;
    for (const auto& [name, value] : values_)
        values += (values.empty() ? "" : " ") + name + "=" + std::to_string(value);
    return values.empty() ? program_ : program_ + " [" + values + "]";
}

} // namespace macula::kernel
