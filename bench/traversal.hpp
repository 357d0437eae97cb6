// `macula bench traversal`: every applicable variant and Embree on the same rays and cores, in one
// run, round by round.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/cases.hpp"
#include "bench/embree_rays.hpp"
#include "host/kernel/variants.hpp"

namespace macula::bench {

struct TraversalOptions {
    std::string device;
    std::vector<std::string> scenes;       // empty: default_scenes()
    std::vector<std::string> scene_path;   // folders
    std::vector<kernel::RayClass> classes; // empty: all
    std::vector<std::string> variants;     // empty: all that apply; named ones run even if unsafe
    std::uint32_t rounds = 7;              // 1..1000
    double limit_seconds = 20.0;           // of one variant on one ray class, all rounds together
    RayOptions rays;
};

// One variant on one ray class of one scene.
struct TraversalRecord {
    std::string scene;
    kernel::RayClass rays = kernel::RayClass::primary;
    std::string variant;
    bool chosen = false; // what the device would use
    std::string skipped; // why there are no figures; empty when there are
    std::uint32_t ray_count = 0, rounds = 0;
    double mrays_per_s = 0.0;        // by wall clock around enqueue and finish, median
    double device_mrays_per_s = 0.0; // by the device's clock; 0: it has none
    std::string embree_best;         // of embree1, embree8, embree16, embree_stream
    double embree_mrays_per_s = 0.0;
    std::array<double, kEmbreeCalls.size()> embree_calls{}; // Mrays/s, in order of kEmbreeCalls
    double ratio = 0.0, ratio_p10 = 0.0, ratio_p90 = 0.0;   // to embree_best, round by round
    double cpu_ratio =
        0.0; // the same by the process's CPU time, which other processes disturb less
    std::uint32_t mismatches_embree = 0, mismatches_reference = 0;
    std::uint32_t ties = 0, rounding = 0; // disagreements with Embree that are none
};

struct TraversalReport {
    std::string device, driver, platform, embree, commit;
    std::uint32_t threads = 0; // Embree's: the device's compute units
    std::vector<TraversalRecord> records;
};

struct TraversalProgress {
    std::function<void(const std::string& line)> note = [](const std::string&) {};
    // Called as soon as a ray class of a scene is complete.
    std::function<void(const TraversalReport& so_far, std::size_t first_new)> records =
        [](const TraversalReport&, std::size_t) {};
};

// Throws std::invalid_argument for options that make no sense, scene::SceneError, compute::Error.
TraversalReport run_traversal(const TraversalOptions& options, const TraversalProgress& progress);

} // namespace macula::bench
