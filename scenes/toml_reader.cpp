#include "scenes/toml_reader.hpp"

#include <cmath>
#include <sstream>

#include <toml++/toml.h>

#include "scenes/json_table.hpp"

namespace macula::scene {
namespace {

constexpr double kMaxCoordinate = 1e18;

std::string spelled(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

} // namespace

// A table of a document that is kept alive with it.
struct TomlTable::Node {
    std::shared_ptr<const toml::table> document;
    const toml::table* table;
    std::string file;
};

TomlDocument::TomlDocument(const std::string& text, const std::string& name) {
    try {
        auto document = std::make_shared<const toml::table>(toml::parse(text, name));
        const toml::table* table = document.get();
        root_ = std::make_shared<const TomlTable::Node>(
            TomlTable::Node{std::move(document), table, name});
    } catch (const toml::parse_error& error) {
        std::ostringstream message;
        message << name << ":" << error.source().begin.line << ":" << error.source().begin.column
                << ": " << error.description();
        throw SceneError(message.str());
    }
}

TomlDocument TomlDocument::from_json(const std::string& text, const std::string& name) {
    auto document = std::make_shared<const toml::table>(json_table(text, name));
    const toml::table* table = document.get();
    return TomlDocument(
        std::make_shared<const TomlTable::Node>(TomlTable::Node{std::move(document), table, name}));
}

TomlTable TomlDocument::root() const {
    return TomlTable(root_);
}

TomlTable::TomlTable(std::shared_ptr<const Node> node)
    : node_(std::move(node)), known_(std::make_shared<std::set<std::string, std::less<>>>()) {}

void TomlTable::fail(std::string_view key, const std::string& what) const {
    const toml::node* value = node_->table->get(key);
    const toml::source_region& source = value != nullptr ? value->source() : node_->table->source();
    std::ostringstream message;
    message << node_->file;
    if (source.begin.line != 0) // what was JSON has none
        message << ":" << source.begin.line;
    message << ": key '" << key << "': " << what;
    throw SceneError(message.str());
}

bool TomlTable::has(std::string_view key) const {
    known_->emplace(key);
    return node_->table->contains(key);
}

std::optional<std::string> TomlTable::string(std::string_view key) const {
    if (!has(key))
        return std::nullopt;
    const auto* value = node_->table->get_as<std::string>(key);
    if (value == nullptr)
        fail(key, "a string was expected");
    return value->get();
}

std::optional<bool> TomlTable::boolean(std::string_view key) const {
    if (!has(key))
        return std::nullopt;
    const auto* value = node_->table->get_as<bool>(key);
    if (value == nullptr)
        fail(key, "true or false was expected");
    return value->get();
}

std::optional<std::int64_t> TomlTable::integer(std::string_view key, std::int64_t lo,
                                               std::int64_t hi) const {
    if (!has(key))
        return std::nullopt;
    const auto* value = node_->table->get_as<std::int64_t>(key);
    if (value == nullptr)
        fail(key, "a whole number was expected");
    if (value->get() < lo || value->get() > hi)
        fail(key, std::to_string(value->get()) + " is not between " + std::to_string(lo) + " and " +
                      std::to_string(hi));
    return value->get();
}

std::optional<float> TomlTable::number(std::string_view key, double lo, double hi) const {
    if (!has(key))
        return std::nullopt;
    const toml::node& value = *node_->table->get(key);
    if (!value.is_number())
        fail(key, "a number was expected");
    const double number = value.value<double>().value_or(std::nan(""));
    if (!(number >= lo && number <= hi))
        fail(key, spelled(number) + " is not between " + spelled(lo) + " and " + spelled(hi));
    return static_cast<float>(number);
}

std::optional<std::vector<double>> TomlTable::numbers(std::string_view key, std::size_t most,
                                                      double lo, double hi) const {
    if (!has(key))
        return std::nullopt;
    const auto* array = node_->table->get_as<toml::array>(key);
    if (array == nullptr || array->size() > most)
        fail(key, "at most " + std::to_string(most) + " numbers [a, b, ...] were expected");
    std::vector<double> result;
    for (const toml::node& element : *array) {
        const double number =
            element.is_number() ? element.value<double>().value_or(std::nan("")) : std::nan("");
        if (!(number >= lo && number <= hi))
            fail(key, "numbers between " + spelled(lo) + " and " + spelled(hi) + " were expected");
        result.push_back(number);
    }
    return result;
}

std::optional<glm::vec3> TomlTable::vec3(std::string_view key) const {
    if (!has(key))
        return std::nullopt;
    const auto* array = node_->table->get_as<toml::array>(key);
    if (array == nullptr || array->size() != 3)
        fail(key, "three numbers [x, y, z] were expected");
    glm::vec3 result(0.0f);
    for (std::size_t i = 0; i < 3; ++i) {
        const toml::node& element = *array->get(i);
        const double number =
            element.is_number() ? element.value<double>().value_or(std::nan("")) : std::nan("");
        if (!(std::fabs(number) < kMaxCoordinate))
            fail(key, "three finite numbers [x, y, z] were expected");
        result[static_cast<int>(i)] = static_cast<float>(number);
    }
    return result;
}

std::optional<glm::vec3> TomlTable::colour(std::string_view key, double hi) const {
    if (!has(key))
        return std::nullopt;
    if (node_->table->get(key)->is_number())
        return glm::vec3(*number(key, 0.0, hi));
    const glm::vec3 result = *vec3(key);
    for (int c = 0; c < 3; ++c)
        if (!(result[c] >= 0.0f && result[c] <= static_cast<float>(hi)))
            fail(key, "its channels must lie between 0 and " + spelled(hi));
    return result;
}

std::optional<glm::vec3> TomlTable::factors(std::string_view key, double lo, double hi) const {
    if (!has(key))
        return std::nullopt;
    const glm::vec3 result = node_->table->get(key)->is_number()
                                 ? glm::vec3(*number(key, -kMaxCoordinate, kMaxCoordinate))
                                 : *vec3(key);
    for (int i = 0; i < 3; ++i)
        if (!(std::fabs(result[i]) >= static_cast<float>(lo) &&
              std::fabs(result[i]) <= static_cast<float>(hi)))
            fail(key, "a size between " + spelled(lo) + " and " + spelled(hi) + " was expected");
    return result;
}

std::vector<std::string> TomlTable::strings(std::string_view key) const {
    if (!has(key))
        return {};
    const toml::array* array = node_->table->get_as<toml::array>(key);
    if (array == nullptr)
        return {*string(key)};
    std::vector<std::string> result;
    for (const toml::node& element : *array) {
        const auto* value = element.as_string();
        if (value == nullptr)
            fail(key, "strings [\"a\", ...] were expected");
        result.push_back(value->get());
    }
    return result;
}

std::optional<TomlTable> TomlTable::table(std::string_view key) const {
    if (!has(key))
        return std::nullopt;
    const auto* value = node_->table->get_as<toml::table>(key);
    if (value == nullptr)
        fail(key, "a table was expected");
    return TomlTable(std::make_shared<const Node>(Node{node_->document, value, node_->file}));
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) const {
    std::vector<TomlTable> result;
    if (!has(key))
        return result;
    const auto* array = node_->table->get_as<toml::array>(key);
    if (array == nullptr)
        fail(key, "tables [[" + std::string(key) + "]] were expected");
    for (const toml::node& element : *array) {
        const toml::table* value = element.as_table();
        if (value == nullptr)
            fail(key, "tables [[" + std::string(key) + "]] were expected");
        result.push_back(
            TomlTable(std::make_shared<const Node>(Node{node_->document, value, node_->file})));
    }
    return result;
}

float TomlTable::required_number(std::string_view key, double lo, double hi) const {
    const std::optional<float> value = number(key, lo, hi);
    if (!value)
        fail(key, "it is missing");
    return *value;
}

glm::vec3 TomlTable::required_vec3(std::string_view key) const {
    const std::optional<glm::vec3> value = vec3(key);
    if (!value)
        fail(key, "it is missing");
    return *value;
}

std::string TomlTable::required_string(std::string_view key) const {
    const std::optional<std::string> value = string(key);
    if (!value)
        fail(key, "it is missing");
    return *value;
}

void TomlTable::reject_unknown() const {
    for (const auto& [key, value] : *node_->table)
        if (!known_->contains(key.str()))
            fail(key.str(), "there is no such key here");
}

} // namespace macula::scene
