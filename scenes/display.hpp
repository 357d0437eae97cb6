// Displays: what decides how many pixels see which part of the view.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace macula::scene {

// One eye's view. FOV tangents are positive magnitudes from the view axis to the image's edges.
struct Display {
    std::string name;
    std::uint32_t width = 0, height = 0; // pixels
    float tan_left = 0.0f, tan_right = 0.0f, tan_up = 0.0f, tan_down = 0.0f;
};

// "dk2" (Oculus Rift DK2, the left eye as rendered by Weier et al. 2016) and "desktop_1080p" (a
// 24-inch screen, 531 mm wide, seen from 600 mm).
std::vector<Display> builtin_displays();

// Throws std::invalid_argument that lists the known names.
Display find_display(std::string_view name);

} // namespace macula::scene
