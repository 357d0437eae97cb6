// A scene and a display of `macula bench rrm`, and the methods that are rendered there.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "bench/rrm.hpp"
#include "host/render/renderer.hpp"
#include "scenes/display.hpp"

namespace macula::bench {

struct RrmMethod {
    std::string name; // "full", "rrm", "lowres_rings"
    std::uint32_t n = 0;
    std::array<float, 3> ring_edges{};
};

class RrmScene {
  public:
    // Throws as load_fly_through and find_display do.
    RrmScene(const RrmOptions& options, const compute::Device& device, const std::string& name);

    render::Renderer make(const RrmMethod& method, std::uint32_t depth,
                          std::vector<std::string> images = {}) const;
    const scene::Scene& scene() const { return scene_; }
    const scene::Display& display() const { return display_; }
    // The first frame's.
    scene::Camera camera() const;
    // Gazes through the middles of columns x rows fields of the image, row by row.
    std::vector<frame::Gaze> gazes() const;
    // The method's edges for as many samples as refresh rate modulation has on average over those
    // gazes, as far as its fovea and the widest blocks allow it: 5 (1, 1 + a, 1 + 3a) degrees.
    std::array<float, 3> ring_edges(std::uint32_t n) const;

  private:
    std::vector<shared::FrameParams> frames() const; // one a gaze

    const RrmOptions& options_;
    scene::Scene scene_;
    scene::Display display_;
    std::shared_ptr<render::DeviceScene> on_device_;
};

} // namespace macula::bench
