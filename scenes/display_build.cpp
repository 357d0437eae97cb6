#include "scenes/display_build.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace macula::scene {
namespace {

void check_range(const std::string& what, double value, double least, double most) {
    if (!(value >= least && value <= most))
        throw std::invalid_argument(what + " must be " + std::to_string(least) + " to " +
                                    std::to_string(most) + ", not " + std::to_string(value));
}

EyeView& eye(Display& display, Eye which) {
    return display.eyes[static_cast<std::size_t>(which)];
}

} // namespace

glm::dmat3 turned_left(double degrees) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const double c = std::cos(angle), s = std::sin(angle);
    return {c, 0.0, -s, 0.0, 1.0, 0.0, s, 0.0, c}; // columns
}

void set_headset(Display& display, const Tangents& left, double ipd, double cant) {
    EyeView view{left.left, left.right, left.up, left.down, {}, turned_left(cant)};
    eye(display, Eye::mono) = view;
    view.offset = {-0.5 * ipd, 0.0, 0.0};
    eye(display, Eye::left) = view;
    eye(display, Eye::right) = {
        left.right, left.left, left.up, left.down, {0.5 * ipd, 0.0, 0.0}, turned_left(-cant)};
}

void set_screen(Display& display, double width, double distance, double ipd) {
    const double half_width = 0.5 * width;
    const double half_height = half_width * display.height / display.width;
    for (const Eye which : {Eye::mono, Eye::left, Eye::right}) {
        const double x = which == Eye::mono ? 0.0 : which == Eye::left ? -0.5 * ipd : 0.5 * ipd;
        eye(display, which) = {(half_width + x) / distance,
                               (half_width - x) / distance,
                               half_height / distance,
                               half_height / distance,
                               {x, 0.0, 0.0},
                               glm::dmat3(1.0)};
    }
}

void check(const Display& display) {
    check_range("the width", display.width, 1, 16384);
    check_range("the height", display.height, 1, 16384);
    check_range("the refresh rate", display.refresh_hz, 1.0, 10000.0);
    for (const EyeView& view : display.eyes) {
        for (const double t : {view.tan_left, view.tan_right, view.tan_up, view.tan_down})
            check_range("a field-of-view tangent", t, 1e-4, 1e3);
        check_range("an eye's distance from the head's middle", glm::length(view.offset), 0.0, 1.0);
    }
    for (const Distortion& colour : display.distortion)
        for (const double k : colour)
            check_range("a distortion coefficient", k, -1e3, 1e3);
}

} // namespace macula::scene
