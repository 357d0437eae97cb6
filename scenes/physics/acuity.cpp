#include "scenes/physics/acuity.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace macula::scene::physics {

float eccentricity(const Observer& observer, const glm::vec3& centre, float radius) {
    const glm::vec3 towards = centre - observer.eye;
    const float distance = glm::length(towards);
    if (distance <= radius)
        return 0.0f;
    const float cosine = glm::dot(towards, observer.gaze) / distance;
    const float angle = std::acos(std::clamp(cosine, -1.0f, 1.0f)) - std::asin(radius / distance);
    return std::max(angle, 0.0f) * (180.0f / std::numbers::pi_v<float>);
}

int levels_left_out(const CollisionAcuity& acuity, float eccentricity_degrees) {
    if (eccentricity_degrees <= acuity.exact_degrees)
        return 0;
    const float beyond = eccentricity_degrees - acuity.exact_degrees;
    return 1 + static_cast<int>(beyond * acuity.levels_per_degree);
}

} // namespace macula::scene::physics
