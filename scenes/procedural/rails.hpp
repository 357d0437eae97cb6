// Nodes that move the instances of built-in scenes: turning, rolling, bouncing. Every motion is
// whole after one period of the scene.
#pragma once

#include <cstdint>
#include <string>

#include "scenes/scene.hpp"

namespace macula::scene::procedural {

// A rotation by `turns` full turns about `axis` (unit length).
glm::quat turned_about(glm::vec3 axis, float turns);

class Rails {
  public:
    // `period`: frames, above 0.
    Rails(Scene& scene, float period) : scene_(scene), period_(period) {
        scene.motion.period = period;
    }

    // A node that stands still in its parent.
    std::uint32_t node(std::uint32_t parent, const Pose& rest = {});
    // `turns` whole turns (of either sign) about `axis` in a period, from the node's rest pose.
    void spin(std::uint32_t node, glm::vec3 axis, int turns);
    // `count` parabolas of this height above the rest pose, touching it in between, where the
    // node is squashed by this part of its height, keeping its volume.
    void bounce(std::uint32_t node, int count, float height, float squash);
    // Up and down by `height` about the rest pose, `count` times.
    void bob(std::uint32_t node, int count, float height);
    // Places a mesh of the scene at the node.
    void carry(std::uint32_t node, std::uint32_t mesh, const std::string& name);

  private:
    Scene& scene_;
    float period_;
};

} // namespace macula::scene::procedural
