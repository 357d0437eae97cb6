// Physics with contacts as coarse as the gaze allows, against exact ones (Smith et al. 2014,
// section 4: 2.01 ms against 1.15 ms a frame, over 1000 frames).
#pragma once

#include <cstdint>

#include "scenes/scene.hpp"

namespace macula::bench {

struct PhysicsOptions {
    std::uint32_t frames = 1000;
    int runs = 3; // times are medians over them
    // The gaze rests on each point of a grid over the picture in turn, which reaches these tangents
    // to either side of the scene's first camera; the camera stands still. One run for each point.
    int columns = 3, rows = 2;                         // at least 1
    float half_width = 0.4425f, half_height = 0.2489f; // desktop_1080p
};

struct PhysicsResult {
    std::uint32_t frames = 0;
    int gazes = 0;
    // Of all steps of a frame, on average over the frames (and, perceptual, over the gazes).
    double ms_exact = 0.0, ms_perceptual = 0.0, speedup = 0.0;
    // The same with the gaze behind the eye's back, where nothing is exact: the paper's case, whose
    // contacts are coarse for the whole scene by hand.
    double ms_coarse = 0.0, speedup_coarse = 0.0;
    // The greatest of all spheres and frames, in units of the spheres' radius.
    double penetration_exact = 0.0, penetration_perceptual = 0.0;
    double bound = 0.0; // what neither exceeds
};

// The scene must have passed validate() and have physics. Throws as scene::physics::World does.
PhysicsResult measure_physics(const scene::Scene& scene, const PhysicsOptions& options = {});

} // namespace macula::bench
