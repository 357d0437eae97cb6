// What an eye tracker does to the truth, and what is done about it. Each function wraps a source;
// tracked() wraps them in the order of a real tracker.
#pragma once

#include <cstdint>

#include "scenes/gaze/source.hpp"

namespace macula::scene {

// Samples become known `latency_ns` after they were measured.
GazePointer with_latency(GazePointer source, std::int64_t latency_ns);
// The tracker measures `hz` times a second and holds between.
GazePointer with_rate(GazePointer source, double hz);
// Normal angular noise, standard deviation `degrees` in each of two directions, new for each
// sample.
GazePointer with_noise(GazePointer source, double degrees, std::uint64_t seed);
// Azimuth and elevation in multiples of `degrees`.
GazePointer with_quantisation(GazePointer source, double degrees);
// In each stretch of `length_ns` all samples are invalid with this probability.
GazePointer with_dropouts(GazePointer source, double probability, std::int64_t length_ns,
                          std::uint64_t seed);
// The auxiliary filter between tracker and renderer of Smith et al. 2014, section 3.2, which the
// paper does not describe further: the mean over the last `window_ns`, read every 4 ms as their
// 250 Hz tracker delivers. A sample more than `saccade_degrees` away from the newest one ends the
// window, so that saccades pass at once. The delay of slow movements is half the window.
GazePointer with_smoothing(GazePointer source, std::int64_t window_ns, double saccade_degrees);
// An invalid sample takes the direction of the last valid one, up to 10 s back, and stays marked as
// invalid; the widening grows to `most` within 50 ms of loss and goes back within 300 ms of valid
// samples. Where nothing valid came before, the gaze is straight ahead at the full widening.
GazePointer with_hold(GazePointer source, double most);
// Makes a live source answer for the last seconds too; every wrapper of one needs it.
GazePointer with_history(GazePointer source);

struct TrackerOptions {
    double latency_ms = 0.0;      // 0..1000
    double rate_hz = 0.0;         // 0: as the source; up to 10000
    double noise_degrees = 0.0;   // 0..20
    double quantum_degrees = 0.0; // 0..20
    double dropout = 0.0;         // probability, 0..1
    double dropout_ms = 100.0;    // 1..10000
    double smooth_ms = 0.0;       // window, 0..1000
    double saccade_degrees = 3.0; // 0.1..180
    double widening = 2.0;        // 1..10
    std::uint64_t seed = 1;
};

// Source, rate, noise, quantisation, dropouts, latency, smoothing, hold; what is 0 is left out, the
// hold never. Throws std::invalid_argument naming an option out of range.
GazePointer tracked(GazePointer source, const TrackerOptions& options);

} // namespace macula::scene
