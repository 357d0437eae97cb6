#include "scenes/json_table.hpp"

#include <nlohmann/json.hpp>

#include "scenes/error.hpp"
#include "scenes/text.hpp"

namespace macula::scene {
namespace {

using nlohmann::json;

constexpr int kMaxDepth = 32;

// Calls insert(value) with the TOML value of `value`, unless that is null.
template <typename Insert>
void convert(const json& value, int depth, Insert&& insert);

toml::table object(const json& value, int depth) {
    toml::table table;
    for (const auto& [key, element] : value.items())
        convert(element, depth, [&, &name = key](auto&& v) { table.insert(name, v); });
    return table;
}

toml::array list(const json& value, int depth) {
    toml::array array;
    for (const json& element : value)
        convert(element, depth, [&](auto&& v) { array.push_back(v); });
    return array;
}

template <typename Insert>
void convert(const json& value, int depth, Insert&& insert) {
    if (depth == 0)
        throw SceneError("it is nested more than " + std::to_string(kMaxDepth) + " levels deep");
    if (value.is_object())
        insert(object(value, depth - 1));
    else if (value.is_array())
        insert(list(value, depth - 1));
    else if (value.is_boolean())
        insert(value.get<bool>());
    else if (value.is_string())
        insert(value.get<std::string>());
    else if (value.is_number_unsigned() && value.get<std::uint64_t>() > INT64_MAX)
        throw SceneError("the number " + value.dump() + " is too large");
    else if (value.is_number_integer())
        insert(value.get<std::int64_t>());
    else if (value.is_number_float())
        insert(value.get<double>());
}

// Parsing that stops at a depth before the parser's own recursion could.
json parse(const std::string& text) {
    return json::parse(text, [](int depth, json::parse_event_t, json&) {
        if (depth > kMaxDepth)
            throw SceneError("it is nested more than " + std::to_string(kMaxDepth) +
                             " levels deep");
        return true;
    });
}

} // namespace

toml::table json_table(const std::string& text, const std::string& name) {
    try {
        const json document = parse(text);
        if (!document.is_object())
            throw SceneError("an object {...} was expected");
        return object(document, kMaxDepth);
    } catch (const json::parse_error& error) {
        throw SceneError(name + ":" + std::to_string(line_number(text, error.byte)) +
                         ": no valid JSON: " + error.what());
    } catch (const json::exception& error) { // a number beyond the range of a double
        throw SceneError(name + ": no valid JSON: " + error.what());
    } catch (const SceneError& error) {
        throw SceneError(name + ": " + error.what());
    }
}

} // namespace macula::scene
