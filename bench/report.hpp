// The traversal benchmark's figures as JSON lines and as tables.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "bench/traversal.hpp"

namespace macula::bench {

// Ratios to Embree's best that the chosen variants are meant to reach on a CPU.
struct Target {
    double every_scene, geometric_mean;
};
std::optional<Target> target(kernel::RayClass ray_class);

// One line of JSON, without the newline. Only for records with figures.
std::string json_line(const TraversalReport& report, const TraversalRecord& record);

// Device, driver, Embree and commit, one a line.
std::string heading(const TraversalReport& report);
// The records of one scene and ray class.
std::string table(std::span<const TraversalRecord> records);
// The chosen variants' ratios by ray class and scene, their least, geometric mean and the targets.
std::string summary(const TraversalReport& report);

} // namespace macula::bench
