#include "host/app/view_options.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <tuple>

#include "scenes/head/pose.hpp"

namespace macula::app {
namespace {

using scene::Display;
using scene::Eye;

[[noreturn]] void refuse(const char* option, const std::string& value, const char* expected) {
    throw std::invalid_argument(fmt::format("{} \"{}\": {}", option, value, expected));
}

// "X,Y": degrees to the right and up.
scene::GazePointer parse_gaze(const std::string& text) {
    double right = 0.0, up = 0.0;
    int end = 0;
    if (std::sscanf(text.c_str(), "%lf,%lf%n", &right, &up, &end) == 2 &&
        text[static_cast<std::size_t>(end)] == '\0' && std::fabs(right) <= 180.0 &&
        std::fabs(up) <= 90.0)
        return scene::fixed_gaze(scene::direction_of_angles(right, up));
    refuse("--gaze", text, "X,Y in degrees to the right and up was expected");
}

} // namespace

void ViewOptions::add_to(CLI::App& command) {
    command.add_option("--display", display,
                       "Size and field of view: a name of `macula displays`, "
                       "or a file .toml or .json");
    command.add_option("--size", size, "WIDTHxHEIGHT in pixels (default 640x480)");
    command
        .add_option("--eyes", eyes, "mono, left, right or both (two views, into left/ and right/)")
        ->capture_default_str();
    command.add_option("--gaze", gaze,
                       "X,Y in degrees to the right and up (default: straight ahead)");
}

std::pair<std::uint32_t, std::uint32_t> size_of(const ViewOptions& options, std::uint32_t width,
                                                std::uint32_t height) {
    if (options.size.empty())
        return {width, height};
    int end = 0;
    if (std::sscanf(options.size.c_str(), "%ux%u%n", &width, &height, &end) != 2 ||
        options.size[static_cast<std::size_t>(end)] != '\0')
        refuse("--size", options.size, "WIDTHxHEIGHT in pixels was expected");
    return {width, height};
}

Display display_of(const ViewOptions& options, const scene::Camera& camera) {
    Display display;
    if (!options.display.empty()) {
        display = scene::find_display(options.display);
    } else {
        display.name = "camera";
        display.width = 640;
        display.height = 480;
    }
    std::tie(display.width, display.height) = size_of(options, display.width, display.height);
    if (options.display.empty()) {
        const frame::Tangents t =
            frame::tangents_of(camera.vertical_fov_degrees, display.width, display.height);
        for (scene::EyeView& eye : display.eyes)
            eye = {t.left, t.right, t.up, t.down, {}, glm::dmat3(1.0)};
    }
    return display;
}

std::vector<Eye> eyes_of(const ViewOptions& options) {
    if (options.eyes == "both")
        return {Eye::left, Eye::right};
    for (const Eye eye : {Eye::mono, Eye::left, Eye::right})
        if (options.eyes == scene::name(eye))
            return {eye};
    refuse("--eyes", options.eyes, "mono, left, right or both was expected");
}

frame::Tangents tangents_of(const scene::EyeView& eye) {
    return {static_cast<float>(eye.tan_left), static_cast<float>(eye.tan_right),
            static_cast<float>(eye.tan_up), static_cast<float>(eye.tan_down)};
}

Views::Views(const ViewOptions& options, const scene::Scene& scene)
    : scene_(scene), display_(display_of(options, scene.cameras.front())) {
    if (options.display.empty() && options.eyes != "mono")
        refuse("--eyes", options.eyes, "only a display (--display) has more than one");
    if (!options.gaze.empty())
        gaze_ = parse_gaze(options.gaze);
}

std::int64_t Views::time_ns(std::uint32_t frame) const {
    return std::llround(frame * (1e9 / display_.refresh_hz));
}

scene::Camera Views::head_at(std::uint32_t frame) const {
    return frame::camera_on_path(scene_, frame);
}

EyeFrame Views::at(std::uint32_t frame, Eye eye) {
    const scene::Camera head = head_at(frame);
    EyeFrame result;
    result.camera = scene::eye_camera(head, display_.eye(eye), 1.0 / scene_.metres_per_unit);
    if (gaze_) {
        result.sample = gaze_->at(time_ns(frame));
        result.gaze.direction = glm::vec3(scene::world_from_head(head) * result.sample.of(eye));
        result.gaze.widening = static_cast<float>(result.sample.widening);
    }
    return result;
}

} // namespace macula::app
