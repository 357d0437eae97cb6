// Which instances of the scene moved since the last frame, and how (kernels/reproject/motion.h).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "host/stage/kit.hpp"
#include "shared/weier.h"

namespace macula::stage {

// Rows of a 3 x 4 matrix: this frame's world from the last one's.
using WorldMotion = std::array<float, 12>;

struct MotionTables {
    std::vector<shared::InstanceMotion> instances; // one an instance, in their order
    std::vector<WorldMotion> matrices;             // one a motion; what moves as one has the same
};

MotionTables find_motions(std::span<const shared::Instance> instances);

// The tables on the device.
class InstanceMotions {
  public:
    // Of the frame that begins; once a frame. Nothing is uploaded where nothing moved.
    void update(const Kit& kit);

    std::uint32_t moved() const { return moved_; }
    std::uint32_t instances() const { return count_; }
    compute::Buffer table, matrices; // none before something moved

  private:
    std::uint32_t moved_ = 0, count_ = 0;
};

} // namespace macula::stage
