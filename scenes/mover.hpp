// Where a scene's instances are, frame by frame.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "scenes/scene.hpp"

namespace macula::scene {

namespace physics {
class World;
}

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
    // Throws as physics::World does.
    explicit Mover(const Scene& scene);
    ~Mover();

    bool moves() const { return moves_; }
    // World from object of all instances in frame `frame`. Key frames depend on the frame alone.
    // Physics steps from the last frame asked for, and anew from frame 0 when that is later; where
    // frames were left out, `observer` has seen them, too.
    std::span<const Transform> at(std::uint32_t frame, const Observer& observer);

  private:
    void place_spheres(std::uint32_t frame, const Observer& observer);

    bool moves_ = false;
    Motion motion_;
    std::vector<Transform> transforms_;
    std::vector<glm::mat4> world_from_node_;
    std::vector<std::uint32_t> spheres_; // instances
    std::unique_ptr<physics::World> world_;
};

} // namespace macula::scene
