// `macula tune`: which variant, with which parameters, is fastest on this device for each ray
// class.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/cases.hpp"
#include "host/stage/trace.hpp"

namespace macula::compute {
class Device;
}

namespace macula::bench {

struct TuneOptions {
    std::vector<std::string> scenes = {"atrium", "voxel_city"}; // built-in ones
    std::uint32_t rounds = 5;
    double limit_seconds = 10.0; // of one candidate on one ray class and scene, all rounds together
    // Variants whose time with standard parameters is within this factor of the fastest one's have
    // their parameters measured, too.
    double worth_tuning = 1.25;
    std::uint32_t furthest = 8; // values up to this factor from a parameter's standard are tried
    RayOptions rays{512, 1};

    static TuneOptions quick();
};

struct TuneCandidate {
    kernel::Choice choice;
    double mrays_per_s = 0.0; // geometric mean over the scenes of the median of rounds
    std::string skipped;      // why there is no figure
};

struct TuneClass {
    kernel::RayClass rays = kernel::RayClass::primary;
    // Fastest first, the skipped ones last; one a variant, with its best parameters where these
    // were measured.
    std::vector<TuneCandidate> candidates;
};

// The values that are tried for a parameter, ascending: its standard and steps of two around it, up
// to a factor of `furthest`, inside its range and the device's largest work-group.
std::vector<std::uint32_t> values_to_try(const kernel::Parameter& parameter, std::uint32_t furthest,
                                         std::uint32_t max_work_group);

// One entry for each ray class; the first candidate of each is the choice unless it was skipped.
// `note` is told what is being measured.
std::vector<TuneClass> tune(compute::Device& device, const TuneOptions& options,
                            const std::function<void(const std::string&)>& note);

} // namespace macula::bench
