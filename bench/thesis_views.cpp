#include "bench/thesis_views.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace macula::bench {
namespace {

constexpr std::array kViews = {
    ThesisView{"sponza", "central", "thesis_sponza", "thesis_atrium", 1, 1, {0.228, 0.263, 0.262}},
    ThesisView{"sponza", "overview", "thesis_sponza", "thesis_atrium", 1, 1, {0.187, 0.221, 0.220}},
    ThesisView{"sponza", "plant", "thesis_sponza", "thesis_atrium", 1, 1, {0.189, 0.200, 0.200}},
    ThesisView{"cornell", "box", "cornell_spheres", "", 3, 4, {0.133, 0.142, 0.139}},
    ThesisView{"temple", "statue", "thesis_temple", "", 1, 1, {0.239, 0.281, 0.280}},
    ThesisView{"temple", "chamber", "thesis_chamber", "", 1, 1, {0.272, 0.304, 0.304}},
};

constexpr std::array kModes = {
    ThesisMode{"full", "full", ""},
    ThesisMode{"logpolar", "logpolar", "foveated"},
    ThesisMode{"logpolar+upscale", "logpolar+upscale", "DLSS"},
    ThesisMode{"logpolar+taa+upscale", "logpolar+taa+upscale", "TAA"},
    ThesisMode{"full+upscale", "full+upscale", ""},
    ThesisMode{"weier+upscale", "weier+upscale", ""},
};

template <typename T, typename Name>
std::vector<T> find(std::span<const T> all, const std::vector<std::string>& names, Name name,
                    const char* option) {
    if (names.empty())
        return {all.begin(), all.end()};
    std::vector<T> found;
    std::vector<std::string> known;
    for (const T& item : all)
        known.emplace_back(name(item));
    for (const std::string& wanted : names) {
        const auto at = std::find(known.begin(), known.end(), wanted);
        if (at == known.end())
            throw std::invalid_argument(
                fmt::format("{} \"{}\": there are {}", option, wanted, fmt::join(known, ", ")));
        found.push_back(all[static_cast<std::size_t>(at - known.begin())]);
    }
    return found;
}

} // namespace

std::string ThesisView::name() const {
    return fmt::format("{} {}", scene, view);
}

std::span<const ThesisView> thesis_views() {
    return kViews;
}

std::span<const ThesisMode> thesis_modes() {
    return kModes;
}

double thesis_ms(std::string_view mode) {
    if (mode == "logpolar")
        return 9.158;
    if (mode == "logpolar+upscale")
        return 5.193;
    return mode == "logpolar+taa+upscale" ? 5.190 : 0.0;
}

double thesis_flip(const ThesisView& view, std::string_view mode) {
    if (mode == "logpolar")
        return view.flip.foveated;
    if (mode == "logpolar+upscale")
        return view.flip.dlss;
    return mode == "logpolar+taa+upscale" ? view.flip.taa : 0.0;
}

std::vector<ThesisView> find_thesis_views(const std::vector<std::string>& names) {
    return find(
        thesis_views(), names, [](const ThesisView& v) { return v.name(); }, "--views");
}

std::vector<ThesisMode> find_thesis_modes(const std::vector<std::string>& names) {
    return find(
        thesis_modes(), names, [](const ThesisMode& m) { return m.name; }, "--modes");
}

} // namespace macula::bench
