// Gaze without a recording: a synthetic observer and the moving target of Weier et al. 2016.
#pragma once

#include <functional>

#include "scenes/gaze/source.hpp"

namespace macula::scene {

// Fixations and saccades. Durations of fixations are log-normal; a saccade of A degrees lasts
// 2.2 A + 21 ms (the main sequence, Carpenter 1988) and follows a minimum-jerk course. Goals are
// normal about the centre, within the limits. Blinks, where asked for, are invalid samples.
struct ObserverOptions {
    std::uint64_t seed = 1;
    double fixation_ms = 300.0;     // median, 50..10000
    double spread_degrees = 8.0;    // standard deviation of the goals, 0..40
    double limit_degrees = 20.0;    // no goal lies further from straight ahead, 1..45
    double blinks_per_minute = 0.0; // 0..60, each 150 ms
};
GazePointer synthetic_observer(const ObserverOptions& options);

// Duration in ms of a saccade of `degrees`.
double saccade_ms(double degrees);

// Distance in metres from the point between the eyes along a unit direction in head space at a
// time, infinite where there is nothing. May be called for any time.
using DepthFunction = std::function<double(std::int64_t time_ns, const glm::dvec3& direction)>;

// The moving target of Weier et al. 2016, section 4.2.1: a point that moves linearly along paths
// across the image plane, fitted to the depth of the scene. Corners are uniform in a rectangle of
// the image plane straight ahead; the speed is constant in tangents. Each eye looks at the point
// in space, whose vergence (1 / distance) is the mean over `depth_window_ms`, so that it does not
// jump at silhouettes.
struct TargetOptions {
    std::uint64_t seed = 1;
    double speed = 10.0;            // degrees a second at the centre, 0.1..200
    double half_width = 20.0;       // degrees of the rectangle, 1..60
    double half_height = 15.0;      // degrees, 1..60
    double depth_window_ms = 400.0; // 0..5000
    glm::dvec3 left_eye{-0.032, 0.0, 0.0}, right_eye{0.032, 0.0, 0.0}; // metres, head space
};
// Without `depth` the target is infinitely far away.
GazePointer moving_target(const TargetOptions& options, DepthFunction depth);

} // namespace macula::scene
