// A scene with the display, the eye and the head of `macula bench quality`, and methods that fly
// through it.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bench/flight.hpp"
#include "bench/quality.hpp"
#include "host/metric/picture.hpp"
#include "host/metric/temporal.hpp"

namespace macula::bench {

// What a method made of the measured frames.
struct Sequence {
    std::vector<metric::Picture> pictures;
    std::vector<double> device_ms, wall_ms; // a frame each; device: sum over the stages
    double samples = 0.0, rays = 0.0;       // means over the frames
    std::vector<report::StageRow> stages;

    // By the device's clock where it has one, else by the host's.
    bool has_device_clock() const;
    const std::vector<double>& ms() const { return has_device_clock() ? device_ms : wall_ms; }
};

class QualityFlight {
  public:
    QualityFlight(const QualityOptions& options, const compute::Device& device,
                  const std::string& scene);

    // A renderer of the flight's view; `change` adds the method to the options.
    render::Renderer make(frame::LightMode lights,
                          const std::function<void(render::Options&)>& change) const;
    render::FrameReport render(render::Renderer& renderer, std::uint32_t frame) const;

    // Each stretch begins with a reset and its warm-up. The first frame of all builds kernels and
    // is rendered once more before. Several renderers take their frames in turn, in an order that
    // changes from frame to frame, so that what slows the machine for a while slows all.
    std::vector<Sequence> fly(std::span<render::Renderer> renderers) const;

    // The measured frames in order; whether each is the first of its stretch.
    struct Spot {
        std::uint32_t frame;
        bool first;
    };
    std::vector<Spot> spots() const;

    const std::string& name() const { return name_; }
    const scene::Scene& scene() const { return scene_; }
    const scene::Display& display() const { return display_; }
    const FlightView& view() const { return *view_; }
    // What a result will say besides its figures.
    report::QualityCase blank() const;

  private:
    const QualityOptions& options_;
    std::string name_;
    scene::Scene scene_;
    scene::Display display_;
    std::string gaze_name_, head_name_;
    std::unique_ptr<FlightView> view_;
    std::shared_ptr<render::DeviceScene> on_device_;
};

// "colour", the last frame of a renderer, and "motion" are copied out of device memory.
metric::Picture copy_colour(const render::Renderer& renderer);
metric::MotionField copy_motion(const render::Renderer& renderer);

} // namespace macula::bench
