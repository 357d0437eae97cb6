#include <cmath>
#include <stdexcept>

#include "scenes/gaze/source.hpp"

namespace macula::scene {
namespace {

class Fixed : public GazeSource {
  public:
    explicit Fixed(const glm::dvec3& direction) : direction_(direction) {}

    GazeSample at(std::int64_t time_ns) override {
        GazeSample sample;
        sample.time_ns = time_ns;
        sample.direction = direction_;
        return sample;
    }

    std::string describe() const override {
        const glm::dvec2 angles = angles_of_direction(direction_);
        return "fixed at " + std::to_string(angles.x) + "," + std::to_string(angles.y) + " degrees";
    }

  private:
    glm::dvec3 direction_;
};

} // namespace

GazePointer fixed_gaze(const glm::dvec3& direction) {
    const double length = glm::length(direction);
    if (!(length > 0.0) || !std::isfinite(length))
        throw std::invalid_argument("a gaze needs a finite direction of some length");
    return std::make_unique<Fixed>(direction / length);
}

} // namespace macula::scene
