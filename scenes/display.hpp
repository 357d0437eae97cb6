// Displays: what decides how many pixels see which part of the view. Angles are degrees. Head space
// is right-handed, in metres: x to the wearer's right, y up, -z forward, the origin between the
// eyes.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/error.hpp"

namespace macula::scene {

// `mono` is one eye in the middle of the head: a desktop's single view, or the left eye's field of
// view where a paper measures "a single eye".
enum class Eye : std::uint8_t { mono, left, right };
const char* name(Eye eye);

// What one eye sees. Eye space is head space moved by `offset` and turned by `head_from_eye`; the
// view axis is its -z. Tangents are positive magnitudes from the view axis to the image's edges.
struct EyeView {
    double tan_left = 1.0, tan_right = 1.0, tan_up = 1.0, tan_down = 1.0;
    glm::dvec3 offset{0.0};        // metres, head space
    glm::dmat3 head_from_eye{1.0}; // a rotation: of canted displays
};

// Radial polynomial of the lens for one colour: a point of the rendered image at the distance r
// (tangent) from the view axis appears at r * (1 + k[0] r^2 + k[1] r^4 + ...).
using Distortion = std::vector<double>;

struct Display {
    std::string name;
    std::string source;                   // where the numbers come from, for people
    std::uint32_t width = 0, height = 0;  // pixels of one eye, each 1..16384
    double refresh_hz = 60.0;             // frames a second
    std::array<EyeView, 3> eyes;          // by Eye
    std::array<Distortion, 3> distortion; // red, green, blue; empty: none
    const EyeView& eye(Eye which) const { return eyes[static_cast<std::size_t>(which)]; }
    double ipd() const; // metres between the eyes
};

// dk2 (as rendered by Weier et al. 2016), desktop_1080p (a 24-inch screen, 531 mm wide, seen from
// 600 mm), vive_pro_eye, quest_pro (asymmetric up and down), pimax_8k_large (canted by 10 degrees).
std::vector<Display> builtin_displays();

// A built-in display, or a file (a name that ends in .toml or .json: read_display). Throws
// std::invalid_argument that lists the known names, and SceneError.
Display find_display(const std::string& name_or_file);

// docs/displays.md describes the files. Throws SceneError naming file, line (TOML) and key.
Display read_display(const std::filesystem::path& file);
Display parse_display(const std::string& text, const std::string& file, bool json);

// Throws std::invalid_argument naming what is out of range.
void check(const Display& display);

// Direction in head space, of unit length, through the point (x, y) of the eye's image in pixels:
// (0, 0) is the image's upper left corner, pixel (i, j)'s centre (i + 0.5, j + 0.5).
glm::dvec3 pixel_direction(const Display& display, Eye eye, double x, double y);

// The image point of a direction in head space; false behind the eye, whatever the image's size.
bool project(const Display& display, Eye eye, const glm::dvec3& direction, double& x, double& y);

// The true angle between two directions of any length above 0, in degrees, 0..180; exact near 0 and
// 180, unlike the arc cosine.
double angle_degrees(const glm::dvec3& a, const glm::dvec3& b);

// Eccentricity: the true angle in degrees between the direction through an image point and `gaze`
// (head space). Never a pixel distance (Weier et al. 2016, section 3.1).
double eccentricity(const Display& display, Eye eye, double x, double y, const glm::dvec3& gaze);

// Pixels per degree along a side of a square of the same solid angle as the pixel at (x, y): a
// tangent plane's density grows off-axis.
double pixels_per_degree(const Display& display, Eye eye, double x, double y);

// Degrees right of and above the view axis of the head: the angles that `--gaze X,Y` takes. The
// direction lies `right` degrees from the plane x = 0 in azimuth, then `up` in elevation.
glm::dvec3 direction_of_angles(double right_degrees, double up_degrees);
// Inverse: azimuth and elevation in degrees.
glm::dvec2 angles_of_direction(const glm::dvec3& direction);

// The lens: r -> r * (1 + k[0] r^2 + ...), and its inverse by Newton's method on the part where it
// grows; some other number where that part does not reach `distorted`. r >= 0.
double distort(const Distortion& k, double r);
double undistort(const Distortion& k, double distorted);

} // namespace macula::scene
