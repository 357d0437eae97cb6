// The views and modes of Mrad 2022, chapter 5, and what the thesis says of them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace macula::bench {

// FLIP's weighted median by mode: tables 5.1 to 5.3 and the text of section 5.1.
struct ThesisFlip {
    double foveated, dlss, taa;
};

struct ThesisView {
    std::string_view scene, view; // the thesis's
    // A scene of load_fly_through(), and the one that stands in where its files are not found.
    std::string_view file, stand_in;
    std::uint32_t depth, reference_depth; // of recursion
    ThesisFlip flip;

    std::string name() const; // "sponza central"
};
std::span<const ThesisView> thesis_views();

struct ThesisMode {
    std::string_view name, method;
    std::string_view thesis; // what the thesis calls it; empty: a mode of ours
};
// full, then the thesis's modes, then further ones of ours.
std::span<const ThesisMode> thesis_modes();
// Of the thesis, table 5.4; 0 where it has none.
double thesis_ms(std::string_view mode);
// Of the thesis, tables 5.1 to 5.3; 0 where it has none.
double thesis_flip(const ThesisView& view, std::string_view mode);

// By their names; empty: all. Throws std::invalid_argument that lists the known names.
std::vector<ThesisView> find_thesis_views(const std::vector<std::string>& names);
std::vector<ThesisMode> find_thesis_modes(const std::vector<std::string>& names);

} // namespace macula::bench
