// What the frames of a method are compared with, kept on disk by content.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/quality_flight.hpp"
#include "host/kernel/program_cache.hpp"
#include "host/metric/temporal.hpp"

namespace macula::bench {

struct ReferenceFrame {
    metric::Picture converged;  // `full` with many samples a pixel
    metric::Picture full;       // with one
    metric::MotionField motion; // from the frame before on the path
};

// The references of one flight with one lighting. A frame's key is the text of all that its pixels
// depend on: scene, kernels, lights, view, this frame's and the last one's camera, size, samples,
// seed. A file that is truncated, altered or of another key counts as absent, and is made anew.
class References {
  public:
    // Flight and options must outlive it. With kernels of MACULA_KERNEL_DIR nothing is cached.
    References(const QualityFlight& flight, const QualityOptions& options, frame::LightMode lights);

    // Of a measured frame.
    ReferenceFrame at(std::uint32_t frame);
    // The file that it would lie in.
    std::filesystem::path file_of(std::uint32_t frame) const;
    // How many were rendered so far.
    std::uint32_t rendered() const { return rendered_; }

  private:
    std::string key(std::uint32_t frame) const;
    ReferenceFrame render(std::uint32_t frame);

    const QualityFlight& flight_;
    const QualityOptions& options_;
    frame::LightMode lights_;
    bool on_disk_;
    kernel::ProgramCache cache_;
    std::string content_; // the part of the key that all frames share
    std::optional<render::Renderer> converged_, full_;
    std::vector<std::pair<std::uint32_t, ReferenceFrame>> kept_; // where nothing is on disk
    std::uint32_t rendered_ = 0;
};

} // namespace macula::bench
