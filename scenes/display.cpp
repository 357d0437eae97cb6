#include "scenes/display.hpp"

#include <stdexcept>

namespace macula::scene {

std::vector<Display> builtin_displays() {
    constexpr float half_width = 0.5f * 531.0f / 600.0f;
    constexpr float half_height = half_width * 1080.0f / 1920.0f;
    return {
        {"dk2", 1182, 1464, 1.0586f, 1.0924f, 1.3299f, 1.3299f},
        {"desktop_1080p", 1920, 1080, half_width, half_width, half_height, half_height},
    };
}

Display find_display(std::string_view name) {
    std::string known;
    for (Display& display : builtin_displays()) {
        if (display.name == name)
            return display;
        known += (known.empty() ? "" : ", ") + display.name;
    }
    throw std::invalid_argument("there is no display \"" + std::string(name) +
                                "\" (known: " + known + ")");
}

} // namespace macula::scene
