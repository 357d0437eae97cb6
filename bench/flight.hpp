// Which frames of a fly-through a benchmark measures, and what the eye sees in each.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "host/render/renderer.hpp"
#include "scenes/gaze/source.hpp"
#include "scenes/head/recording.hpp"
#include "scenes/scene.hpp"

namespace macula::bench {

// Frames of a path: `segments` consecutive stretches that are spread over it evenly.
class Schedule {
  public:
    // Throws std::invalid_argument that names the option out of range: 1..100000 frames,
    // 1..frames segments, 1..1000 frames of warm-up before each.
    Schedule(std::uint32_t frames, std::uint32_t segments, std::uint32_t warm_up,
             std::uint32_t path_frames);

    std::uint32_t segments() const { return segments_; }
    std::uint32_t warm_up() const { return warm_up_; }
    // The first measured frame of a segment, after its warm-up.
    std::uint32_t first(std::uint32_t segment) const;
    // How many of the measured frames belong to the segment.
    std::uint32_t count(std::uint32_t segment) const;

  private:
    std::uint32_t frames_, segments_, warm_up_, path_;
};

struct FlightFrame {
    scene::Camera camera;
    frame::Gaze gaze;
    glm::dvec3 look; // where the gaze goes, head space
};

// The middle eye along the scene's path; frame N is at the time N / refresh rate.
class FlightView {
  public:
    // Scene and display must outlive it. `head`: moves on top of the path. Throws
    // std::invalid_argument for a live gaze: a benchmark needs one that can be repeated.
    FlightView(const scene::Scene& scene, const scene::Display& display, scene::GazePointer gaze,
               std::optional<scene::RecordedHead> head = {});

    FlightFrame at(std::uint32_t frame) const;

  private:
    const scene::Scene& scene_;
    const scene::Display& display_;
    scene::GazePointer gaze_;
    std::optional<scene::RecordedHead> head_;
};

// scene::find_display with another size in pixels, unless `width` is 0.
scene::Display sized_display(const std::string& name, std::uint32_t width, std::uint32_t height);

// The middle eye's field of view as the renderer takes it.
frame::Tangents tangents_of(const scene::Display& display);

// Rays from the camera in a frame: samples of the image.
double camera_rays(const render::FrameReport& report);

} // namespace macula::bench
