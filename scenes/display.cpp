#include "scenes/display.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace macula::scene {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

} // namespace

const char* name(Eye eye) {
    static constexpr const char* kNames[] = {"mono", "left", "right"};
    return kNames[static_cast<std::size_t>(eye)];
}

double Display::ipd() const {
    return glm::length(eye(Eye::right).offset - eye(Eye::left).offset);
}

Display find_display(const std::string& name_or_file) {
    const std::string extension = std::filesystem::path(name_or_file).extension().string();
    if (extension == ".toml" || extension == ".json")
        return read_display(name_or_file);
    std::string known;
    for (Display& display : builtin_displays()) {
        if (display.name == name_or_file)
            return display;
        known += (known.empty() ? "" : ", ") + display.name;
    }
    throw std::invalid_argument("there is no display \"" + name_or_file + "\" (known: " + known +
                                "; or a file .toml or .json)");
}

glm::dvec3 pixel_direction(const Display& display, Eye eye, double x, double y) {
    const EyeView& view = display.eye(eye);
    const double sx = x / display.width * (view.tan_right + view.tan_left) - view.tan_left;
    const double sy = view.tan_up - y / display.height * (view.tan_up + view.tan_down);
    return glm::normalize(view.head_from_eye * glm::dvec3(sx, sy, -1.0));
}

bool project(const Display& display, Eye eye, const glm::dvec3& direction, double& x, double& y) {
    const EyeView& view = display.eye(eye);
    const glm::dvec3 d = glm::transpose(view.head_from_eye) * direction;
    if (!(-d.z > 1e-12 * glm::length(d)))
        return false;
    x = (d.x / -d.z + view.tan_left) / (view.tan_right + view.tan_left) * display.width;
    y = (view.tan_up - d.y / -d.z) / (view.tan_up + view.tan_down) * display.height;
    return true;
}

double angle_degrees(const glm::dvec3& a, const glm::dvec3& b) {
    return kDegrees * std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

double eccentricity(const Display& display, Eye eye, double x, double y, const glm::dvec3& gaze) {
    return angle_degrees(pixel_direction(display, eye, x, y), gaze);
}

double pixels_per_degree(const Display& display, Eye eye, double x, double y) {
    const EyeView& view = display.eye(eye);
    const double width = view.tan_right + view.tan_left, height = view.tan_up + view.tan_down;
    const double sx = x / display.width * width - view.tan_left;
    const double sy = view.tan_up - y / display.height * height;
    // dsx dsy on the plane at distance 1 is a solid angle of dsx dsy / (1 + sx^2 + sy^2)^(3/2).
    const double density = (display.width / width) * (display.height / height);
    return std::sqrt(density * std::pow(1.0 + sx * sx + sy * sy, 1.5)) / kDegrees;
}

glm::dvec3 direction_of_angles(double right_degrees, double up_degrees) {
    const double azimuth = right_degrees / kDegrees, elevation = up_degrees / kDegrees;
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
            -std::cos(azimuth) * std::cos(elevation)};
}

glm::dvec2 angles_of_direction(const glm::dvec3& direction) {
    const double flat = std::hypot(direction.x, direction.z);
    return {kDegrees * std::atan2(direction.x, -direction.z),
            kDegrees * std::atan2(direction.y, flat)};
}

double distort(const Distortion& k, double r) {
    double factor = 0.0;
    for (std::size_t i = k.size(); i-- > 0;)
        factor = (factor + k[i]) * r * r;
    return r * (1.0 + factor);
}

double undistort(const Distortion& k, double distorted) {
    double r = distorted;
    for (int step = 0; step < 50; ++step) {
        double slope = 1.0, power = 1.0;
        for (std::size_t i = 0; i < k.size(); ++i) {
            power *= r * r;
            slope += k[i] * power * static_cast<double>(2 * i + 3);
        }
        if (!(slope > 0.0)) { // beyond the part where it grows
            r *= 0.5;
            continue;
        }
        const double error = distort(k, r) - distorted;
        if (std::fabs(error) < 1e-14 * std::fmax(1.0, distorted))
            break;
        r -= error / slope;
    }
    return r;
}

} // namespace macula::scene
