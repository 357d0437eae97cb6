// Where the wearer looks, at any time: one interface for recordings, models and live trackers.
// Directions are in head space (scenes/display.hpp): x right, y up, -z forward.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <glm/glm.hpp>

#include "scenes/display.hpp"

namespace macula::scene {

struct GazeSample {
    std::int64_t time_ns = 0;             // when it was measured, not when it was asked for
    glm::dvec3 direction{0.0, 0.0, -1.0}; // unit; of both eyes together
    // Of each eye, where the source knows them apart; unit.
    std::optional<glm::dvec3> left, right;
    bool valid = true;       // false: `direction` means nothing (blinks, lost tracking)
    double confidence = 1.0; // 0..1
    double widening = 1.0;   // factor on the foveal region's r0 and r1 that methods apply, >= 1

    const glm::dvec3& of(Eye eye) const {
        const auto& own = eye == Eye::left ? left : right;
        return eye == Eye::mono || !own ? direction : *own;
    }
};

// at(t) is the newest sample whose time is not after t (nanoseconds from the start of the run).
// Sources are pure functions of time, so that any frame can be rendered on its own, except live
// ones, whose samples come from outside. Not for several threads at once.
class GazeSource {
  public:
    virtual ~GazeSource() = default;
    virtual GazeSample at(std::int64_t time_ns) = 0;
    virtual bool live() const { return false; }
    // What came in so far, of live sources; else empty.
    virtual std::string status() const { return {}; }
    virtual std::string describe() const = 0; // for messages and metadata, without line ends
};

using GazePointer = std::unique_ptr<GazeSource>;

// Looks in one direction for ever (head space, any length above 0).
GazePointer fixed_gaze(const glm::dvec3& direction);

} // namespace macula::scene
