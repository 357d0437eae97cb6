// Where a scene's instances are, frame by frame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scenes/scene.hpp"

namespace macula::scene {

// Who looks at a frame: physics is coarser where nobody looks closely.
struct Observer {
    glm::vec3 eye{0.0f};               // world space
    glm::vec3 gaze{0.0f, 0.0f, -1.0f}; // unit length, world space
};

// Indices of the instances that some motion or physics moves, in increasing order.
std::vector<std::uint32_t> moving_instances(const Scene& scene);

class Mover {
  public:
    // The scene must have passed validate(); it may be destroyed afterwards.
    explicit Mover(const Scene& scene);

    bool moves() const { return moves_; }
    // World from object of all instances in frame `frame`. Key frames depend on the frame alone.
    std::span<const Transform> at(std::uint32_t frame, const Observer& observer);

  private:
    bool moves_ = false;
    Motion motion_;
    std::vector<Transform> transforms_;
    std::vector<glm::mat4> world_from_node_;
};

} // namespace macula::scene
