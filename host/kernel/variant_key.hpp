/// Names one build of one program: the only producer of -D flags.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace macula::kernel {

/// A program and the values that it is compiled with. Each parameter `name` becomes the macro
/// MACULA_<NAME>; a program that never mentions that macro is an error when it is built, so that a
/// misspelt parameter cannot be ignored in silence.
///
///     VariantKey("traverse/wide8").any_hit(true).masks(false).parameter("work_group", 64)
class VariantKey {
  public:
    /// `program`: path below kernels/ without ".cl", e.g. "traverse/wide8".
    explicit VariantKey(std::string program);

    /// The query kind of the traversal contract: any hit or closest hit.
    VariantKey& any_hit(bool value) { return define("any_hit", value ? 1 : 0); }
    /// False when the scene is one identity instance.
    VariantKey& instances(bool value) { return define("instances", value ? 1 : 0); }
    /// False when no triangle has an alpha mask.
    VariantKey& masks(bool value) { return define("masks", value ? 1 : 0); }
    /// An integer such as a work-group size. `name`: lower-case letters, digits and underscores,
    /// starting with a letter. Throws std::invalid_argument for another name and for one of the
    /// above or of the options that the library sets itself.
    VariantKey& parameter(std::string_view name, std::int64_t value);

    const std::string& program() const { return program_; }
    /// Ordered by name, so that the order of the calls does not matter.
    const std::map<std::string, std::int64_t, std::less<>>& values() const { return values_; }

    /// "-DMACULA_ANY_HIT=1 -DMACULA_WORK_GROUP=64".
    std::string options() const;
    /// "traverse/wide8 [any_hit=1 work_group=64]", for messages.
    std::string text() const;

    static std::string macro_name(std::string_view parameter);

    friend bool operator==(const VariantKey&, const VariantKey&) = default;

  private:
    VariantKey& define(std::string_view name, std::int64_t value);

    std::string program_;
    std::map<std::string, std::int64_t, std::less<>> values_;
};

} // namespace macula::kernel
