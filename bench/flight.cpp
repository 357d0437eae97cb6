#include "bench/flight.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scenes/head/pose.hpp"

namespace macula::bench {

Schedule::Schedule(std::uint32_t frames, std::uint32_t segments, std::uint32_t warm_up,
                   std::uint32_t path_frames)
    : frames_(frames), segments_(segments), warm_up_(warm_up),
      path_(std::max(path_frames, frames)) {
    if (frames < 1 || frames > 100000)
        throw std::invalid_argument("--frames must lie between 1 and 100000");
    if (segments < 1 || segments > frames)
        throw std::invalid_argument("--segments must lie between 1 and the number of frames");
    if (warm_up < 1 || warm_up > 1000)
        throw std::invalid_argument("--warm-up must lie between 1 and 1000");
}

std::uint32_t Schedule::first(std::uint32_t segment) const {
    const std::uint64_t from = std::uint64_t{path_} * segment / segments_;
    return static_cast<std::uint32_t>(from) + warm_up_;
}

std::uint32_t Schedule::count(std::uint32_t segment) const {
    const auto before = [&](std::uint32_t s) {
        return static_cast<std::uint32_t>(std::uint64_t{frames_} * s / segments_);
    };
    return before(segment + 1) - before(segment);
}

FlightView::FlightView(const scene::Scene& scene, const scene::Display& display,
                       scene::GazePointer gaze, std::optional<scene::RecordedHead> head)
    : scene_(scene), display_(display), gaze_(std::move(gaze)), head_(std::move(head)) {
    if (gaze_->live())
        throw std::invalid_argument("--gaze " + gaze_->describe() +
                                    ": a benchmark needs a gaze that can be repeated");
}

FlightFrame FlightView::at(std::uint32_t frame) const {
    const auto time_ns =
        static_cast<std::int64_t>(std::llround(frame * (1e9 / display_.refresh_hz)));
    const double units_per_metre = 1.0 / scene_.metres_per_unit;
    scene::Camera head = frame::camera_on_path(scene_, frame);
    if (head_)
        head = head_->on(head, time_ns, units_per_metre);
    const scene::GazeSample sample = gaze_->at(time_ns);
    FlightFrame result;
    result.look = sample.of(scene::Eye::mono);
    result.gaze.direction = glm::vec3(scene::world_from_head(head) * result.look);
    result.gaze.widening = static_cast<float>(sample.widening);
    result.camera = scene::eye_camera(head, display_.eye(scene::Eye::mono), units_per_metre);
    return result;
}

scene::Display sized_display(const std::string& name, std::uint32_t width, std::uint32_t height) {
    scene::Display display = scene::find_display(name);
    if (width != 0) {
        display.width = width;
        display.height = height;
    }
    return display;
}

frame::Tangents tangents_of(const scene::Display& display) {
    const scene::EyeView& eye = display.eye(scene::Eye::mono);
    return {static_cast<float>(eye.tan_left), static_cast<float>(eye.tan_right),
            static_cast<float>(eye.tan_up), static_cast<float>(eye.tan_down)};
}

double camera_rays(const render::FrameReport& report) {
    return static_cast<double>(report.rays[static_cast<std::size_t>(kernel::RayClass::primary)] +
                               report.rays[static_cast<std::size_t>(kernel::RayClass::sparse)]);
}

} // namespace macula::bench
