// What one method needed for some measured frames.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "bench/stage_groups.hpp"
#include "host/render/renderer.hpp"

namespace macula::bench {

// An entry a frame in each list.
struct Series {
    std::vector<double> device_ms, wall_ms;                 // of all stages; of the whole frame
    std::vector<double> rays, camera_rays;                  // of all kinds; samples of the image
    std::array<std::vector<double>, kStageGroups> group_ms; // device

    // Throws std::invalid_argument for a stage without a group.
    void add(const render::FrameReport& report);
};

// Throws nothing; the mean of no values is not a number.
double mean(std::span<const double> values);

} // namespace macula::bench
