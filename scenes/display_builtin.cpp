#include <cmath>

#include "scenes/display_build.hpp"

namespace macula::scene {
namespace {

Display dk2() {
    Display d;
    d.name = "dk2";
    d.source = "Oculus Rift DK2 as rendered by Weier et al. 2016; tangents of the Oculus SDK";
    d.width = 1182;
    d.height = 1464;
    d.refresh_hz = 75.0;
    set_headset(d, {1.0586, 1.0924, 1.3299, 1.3299}, 0.064, 0.0);
    return d;
}

Display desktop_1080p() {
    Display d;
    d.name = "desktop_1080p";
    d.source = "24-inch screen, 531 mm wide, seen from 600 mm";
    d.width = 1920;
    d.height = 1080;
    d.refresh_hz = 60.0;
    set_screen(d, 0.531, 0.6, 0.063);
    return d;
}

// The two eyes' recorded tangents differ: each lens is measured in the factory.
Display vive_pro_eye() {
    Display d;
    d.name = "vive_pro_eye";
    d.source = "HTC Vive Pro Eye: its panels; tangents recorded from a Vive Pro by hmdq (hmdgdb)";
    d.width = 1440;
    d.height = 1600;
    d.refresh_hz = 90.0;
    set_headset(d, {1.349482, 1.205826, 1.425338, 1.415776}, 0.064, 0.0);
    EyeView& right = d.eyes[static_cast<std::size_t>(Eye::right)];
    right.tan_left = 1.208661;
    right.tan_right = 1.356241;
    right.tan_up = 1.426925;
    right.tan_down = 1.423063;
    return d;
}

Display quest_pro() {
    Display d;
    d.name = "quest_pro";
    d.source = "Meta Quest Pro at its recommended size, recorded by hmdq (hmdgdb)";
    d.width = 2160;
    d.height = 2224;
    d.refresh_hz = 72.0;
    set_headset(d, {1.376382, 0.839100, 0.900404, 1.376382}, 0.065174, 0.0);
    return d;
}

Display pimax_8k_large() {
    Display d;
    d.name = "pimax_8k_large";
    d.source =
        "Pimax 8K, large field of view, panels canted by 10 degrees, recorded by hmdq (hmdgdb)";
    d.width = 3024;
    d.height = 1920;
    d.refresh_hz = 80.0;
    set_headset(d, {2.769231, 1.346154, 1.306135, 1.306135}, 0.067004, 10.0);
    return d;
}

} // namespace

std::vector<Display> builtin_displays() {
    return {dk2(), desktop_1080p(), vive_pro_eye(), quest_pro(), pimax_8k_large()};
}

} // namespace macula::scene
