/// Distances in a scene, on the CPU: what a moving gaze target is fitted to.
#pragma once

#include <memory>

#include "scenes/scene.hpp"

namespace macula::app {

class SceneDepth {
  public:
    /// Builds a tree over all triangles, as if none had holes; the scene may be destroyed
    /// afterwards.
    explicit SceneDepth(const scene::Scene& scene);
    ~SceneDepth();

    /// Distance in world units from `origin` along a direction of any length above 0; infinite
    /// where nothing is hit.
    double along(const glm::vec3& origin, const glm::vec3& direction) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace macula::app
