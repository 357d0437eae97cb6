/// `macula displays`: the built-in displays, or one from a file.
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <memory>
#include <numbers>

#include "host/app/command.hpp"
#include "scenes/gaze/spec.hpp"

namespace {

using namespace macula;
using nlohmann::ordered_json;
using scene::Display;
using scene::Eye;

constexpr Eye kEyes[] = {Eye::mono, Eye::left, Eye::right};

struct Options {
    std::string name, gaze = "0,0";
    bool json = false;
};

double degrees(double tangent) {
    return std::atan(tangent) * 180.0 / std::numbers::pi;
}

/// Where one looks from one eye: the pixel, and what the pixels there are worth.
struct Spot {
    double x = 0.0, y = 0.0, pixels_per_degree = 0.0;
    bool inside = false; // the image
};

Spot spot_of(const Display& display, Eye eye, const glm::dvec3& direction) {
    Spot spot;
    if (!scene::project(display, eye, direction, spot.x, spot.y))
        return spot;
    spot.inside =
        spot.x >= 0.0 && spot.y >= 0.0 && spot.x <= display.width && spot.y <= display.height;
    spot.pixels_per_degree = scene::pixels_per_degree(display, eye, spot.x, spot.y);
    return spot;
}

/// Pixels per degree on the eye's view axis, wherever that lies in the image.
double at_axis(const Display& display, Eye eye) {
    return spot_of(display, eye, -display.eye(eye).head_from_eye[2]).pixels_per_degree;
}

ordered_json to_json(const Display& display, Eye eye, const glm::dvec3& gaze) {
    const scene::EyeView& view = display.eye(eye);
    const Spot spot = spot_of(display, eye, gaze);
    const glm::dvec2 axis = scene::angles_of_direction(-view.head_from_eye[2]);
    ordered_json json{{"eye", scene::name(eye)},
                      {"tangents",
                       {{"left", view.tan_left},
                        {"right", view.tan_right},
                        {"up", view.tan_up},
                        {"down", view.tan_down}}},
                      {"offset_metres", {view.offset.x, view.offset.y, view.offset.z}},
                      {"axis_degrees", {axis.x, axis.y}},
                      {"pixels_per_degree", {{"axis", at_axis(display, eye)}, {"gaze", nullptr}}},
                      {"gaze_pixel", nullptr}};
    if (spot.inside) {
        json["pixels_per_degree"]["gaze"] = spot.pixels_per_degree;
        json["gaze_pixel"] = {spot.x, spot.y};
    }
    return json;
}

ordered_json to_json(const Display& display, const glm::dvec3& gaze) {
    ordered_json eyes = ordered_json::array();
    for (const Eye eye : kEyes)
        eyes.push_back(to_json(display, eye, gaze));
    return {{"name", display.name},
            {"source", display.source},
            {"width", display.width},
            {"height", display.height},
            {"refresh_hz", display.refresh_hz},
            {"ipd_mm", 1000.0 * display.ipd()},
            {"distortion",
             {{"red", display.distortion[0]},
              {"green", display.distortion[1]},
              {"blue", display.distortion[2]}}},
            {"eyes", eyes}};
}

void print(const Display& display, const glm::dvec3& gaze) {
    fmt::print("{}: {} x {} pixels an eye, {:g} Hz, {:.1f} mm between the eyes\n    {}\n",
               display.name, display.width, display.height, display.refresh_hz,
               1000.0 * display.ipd(), display.source);
    for (const Eye eye : kEyes) {
        const scene::EyeView& view = display.eye(eye);
        const Spot spot = spot_of(display, eye, gaze);
        fmt::print("    {:<6} {:5.1f} left {:5.1f} right {:5.1f} up {:5.1f} down (degrees), {:.2f} "
                   "pixels per degree on its axis",
                   scene::name(eye), degrees(view.tan_left), degrees(view.tan_right),
                   degrees(view.tan_up), degrees(view.tan_down), at_axis(display, eye));
        if (spot.inside)
            fmt::print(", {:.2f} at the gaze ({:.1f}, {:.1f})\n", spot.pixels_per_degree, spot.x,
                       spot.y);
        else
            fmt::print("; the gaze lies outside the image\n");
    }
}

/// Where the gaze looks at first.
glm::dvec3 direction_of(const Display& display, const std::string& gaze) {
    return scene::parse_gaze(gaze, {display, Eye::mono, {}})->at(0).direction;
}

int run(const Options& options) {
    const std::vector<Display> displays =
        options.name.empty() ? scene::builtin_displays()
                             : std::vector<Display>{scene::find_display(options.name)};
    if (options.json) {
        ordered_json list = ordered_json::array();
        for (const Display& display : displays)
            list.push_back(to_json(display, direction_of(display, options.gaze)));
        fmt::print("{}\n", ordered_json{{"displays", list}}.dump(2));
        return 0;
    }
    for (const Display& display : displays)
        print(display, direction_of(display, options.gaze));
    return 0;
}

app::Run add(CLI::App& command) {
    auto options = std::make_shared<Options>();
    command.add_option("display", options->name, "One of them, or a file .toml or .json");
    command.add_option("--gaze", options->gaze, "As --gaze of render; where it looks at first")
        ->capture_default_str();
    command.add_flag("--json", options->json, "Print one JSON document");
    return [options] { return run(*options); };
}

const app::Command command("displays", "List displays: size, field of view, pixels per degree",
                           add);

} // namespace
