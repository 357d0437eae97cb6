#include "host/app/view_options.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <tuple>

#include "host/app/scene_depth.hpp"
#include "scenes/gaze/spec.hpp"
#include "scenes/head/pose.hpp"

namespace macula::app {
namespace {

using scene::Display;
using scene::Eye;

[[noreturn]] void refuse(const char* option, const std::string& value, const char* expected) {
    throw std::invalid_argument(fmt::format("{} \"{}\": {}", option, value, expected));
}

} // namespace

void ViewOptions::add_to(CLI::App& command) {
    command.add_option(
        "--display", display,
        "Size and field of view: a name of `macula displays`, a file .toml or .json, "
        "or none (default: the scene file's)");
    command.add_flag("--distort", distort, "Warp the pictures for the display's lens");
    command.add_option("--size", size, "WIDTHxHEIGHT in pixels (default 640x480)");
    command
        .add_option("--eyes", eyes, "mono, left, right or both (two views, into left/ and right/)")
        ->capture_default_str();
    command.add_option(
        "--gaze", gaze,
        "Where the eyes look: X,Y in degrees to the right and up, pixel:X,Y, target, "
        "synthetic, FILE.csv, udp:PORT or none, see docs/gaze.md (default: the scene file's, or "
        "none)");
    command.add_option("--tracker", tracker,
                       "What an eye tracker makes of it, e.g. latency=30,noise=0.5,smooth=40");
    command.add_option("--head", head,
                       "What carries the head: as --path, or a recording FILE.csv on top of it");
}

void take_views_of(const scene::Scene& scene, ViewOptions& options) {
    const auto settle = [](std::string& option, const std::optional<std::string>& preferred) {
        if (option.empty())
            option = preferred.value_or("none");
        if (option == "none")
            option.clear();
    };
    settle(options.display, scene.display);
    settle(options.gaze, scene.gaze);
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

bool head_is_recorded(const ViewOptions& options) {
    return options.head.ends_with(".csv");
}

Views::Views(const ViewOptions& options, const scene::Scene& scene)
    : scene_(scene), display_(display_of(options, scene.cameras.front())) {
    if (options.display.empty() && options.eyes != "mono")
        refuse("--eyes", options.eyes, "only a display (--display) has more than one");
    if (head_is_recorded(options))
        head_.emplace(scene::read_head_csv(options.head));
    const scene::TrackerOptions tracker = scene::parse_tracker(options.tracker);
    if (options.gaze.empty() && !options.tracker.empty())
        refuse("--tracker", options.tracker, "it needs a gaze (--gaze) to track");
    if (options.gaze.empty())
        return;
    const scene::GazeContext context{
        display_, eyes_of(options).front(),
        [this](std::int64_t time_ns, const glm::dvec3& d) { return depth(time_ns, d); }};
    gaze_ = scene::tracked(scene::parse_gaze(options.gaze, context), tracker);
}

Views::~Views() = default;

std::string Views::gaze_source() const {
    return gaze_ ? gaze_->describe() : "";
}

std::string Views::gaze_status() const {
    return gaze_ ? gaze_->status() : "";
}

std::int64_t Views::time_ns(std::uint32_t frame) const {
    return std::llround(frame * (1e9 / display_.refresh_hz));
}

scene::Camera Views::head_at(std::int64_t time_ns) const {
    const scene::Camera body = frame::camera_at(
        scene_, static_cast<float>(1e-9 * static_cast<double>(time_ns) * display_.refresh_hz));
    return head_ ? head_->on(body, time_ns, 1.0 / scene_.metres_per_unit) : body;
}

double Views::depth(std::int64_t time_ns, const glm::dvec3& direction) {
    if (!depth_)
        depth_ = std::make_unique<SceneDepth>(scene_);
    const scene::Camera head = head_at(time_ns);
    const glm::dvec3 world = scene::world_from_head(head) * direction;
    return depth_->along(head.eye, glm::vec3(world)) * scene_.metres_per_unit;
}

const scene::GazeSample& Views::sample_at(std::uint32_t frame) {
    if (sampled_frame_ != frame)
        sample_ = gaze_->at(time_ns(frame));
    sampled_frame_ = frame;
    return sample_;
}

EyeFrame Views::at(std::uint32_t frame, Eye eye) {
    scene::Camera head = frame::camera_on_path(scene_, frame);
    if (head_)
        head = head_->on(head, time_ns(frame), 1.0 / scene_.metres_per_unit);
    EyeFrame result;
    result.camera = scene::eye_camera(head, display_.eye(eye), 1.0 / scene_.metres_per_unit);
    if (gaze_) {
        result.sample = sample_at(frame);
        result.gaze.direction = glm::vec3(scene::world_from_head(head) * result.sample.of(eye));
        result.gaze.widening = static_cast<float>(result.sample.widening);
    }
    return result;
}

} // namespace macula::app
