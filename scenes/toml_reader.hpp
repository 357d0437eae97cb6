// Reading of TOML tables with errors that give file, line and key, and that notices keys nobody
// asked for.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/error.hpp"

namespace macula::scene {

// A spelling and what it stands for.
template <typename T>
struct KeyedValue {
    std::string_view name;
    T value;
};

// One table. Every getter marks its key as known and throws SceneError when the value has another
// type or lies outside the closed range; an absent key gives nothing.
class TomlTable {
  public:
    bool has(std::string_view key) const;
    std::optional<std::string> string(std::string_view key) const;
    std::optional<std::int64_t> integer(std::string_view key, std::int64_t lo,
                                        std::int64_t hi) const;
    std::optional<float> number(std::string_view key, double lo, double hi) const;
    std::optional<bool> boolean(std::string_view key) const;
    // [a, b, ...], at most `most` of them.
    std::optional<std::vector<double>> numbers(std::string_view key, std::size_t most, double lo,
                                               double hi) const;
    // [x, y, z], each below 1e18 in size.
    std::optional<glm::vec3> vec3(std::string_view key) const;
    // [r, g, b] or one grey value, each in 0 .. hi; linear RGB.
    std::optional<glm::vec3> colour(std::string_view key, double hi) const;
    // [x, y, z] or one number for all three, each between lo and hi (lo > 0) in size.
    std::optional<glm::vec3> factors(std::string_view key, double lo, double hi) const;
    // ["a", "b", ...] or "a"; empty when absent.
    std::vector<std::string> strings(std::string_view key) const;
    std::optional<TomlTable> table(std::string_view key) const;
    std::vector<TomlTable> tables(std::string_view key) const; // [[key]]; empty when absent

    float required_number(std::string_view key, double lo, double hi) const;
    glm::vec3 required_vec3(std::string_view key) const;
    std::string required_string(std::string_view key) const;

    template <typename T>
    std::optional<T> choice(std::string_view key, std::span<const KeyedValue<T>> values) const {
        const std::optional<std::string> text = string(key);
        if (!text)
            return std::nullopt;
        std::string names;
        for (const KeyedValue<T>& value : values) {
            if (value.name == *text)
                return value.value;
            names += (names.empty() ? "" : ", ") + std::string(value.name);
        }
        fail(key, "'" + *text + "' is none of: " + names);
    }

    // Throws for the first key that no getter has asked for.
    void reject_unknown() const;

    // The message begins with file, line and key.
    [[noreturn]] void fail(std::string_view key, const std::string& what) const;

  private:
    friend class TomlDocument;
    struct Node;
    explicit TomlTable(std::shared_ptr<const Node> node);
    std::shared_ptr<const Node> node_;
    std::shared_ptr<std::set<std::string, std::less<>>> known_;
};

class TomlDocument {
  public:
    // Throws SceneError with line and column when `text` is no TOML. `name` begins every message.
    TomlDocument(const std::string& text, const std::string& name);
    // The same for a JSON object; null values count as absent. Messages about keys then come
    // without a line.
    static TomlDocument from_json(const std::string& text, const std::string& name);
    TomlTable root() const;

  private:
    explicit TomlDocument(std::shared_ptr<const TomlTable::Node> root) : root_(std::move(root)) {}
    std::shared_ptr<const TomlTable::Node> root_;
};

} // namespace macula::scene
