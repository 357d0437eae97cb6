// What `macula bench rrm` measures: speed over foveal positions, quality along a path.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bench/rrm_scene.hpp"

namespace macula::bench {

using RrmNote = std::function<void(const std::string& line)>;

// The methods beside `full`, at each of the scene's gazes in turn; all take their frames there one
// after another, in an order that changes from gaze to gaze.
std::vector<RrmSpeed> measure_speed(const RrmScene& scene, const RrmOptions& options,
                                    std::span<const RrmMethod> methods, std::uint32_t depth,
                                    const RrmNote& note);

// The methods beside `full` along the scene's path, from frame `first` on, before which they have
// rendered all frames.
std::vector<RrmQuality> measure_quality(const RrmScene& scene, const RrmOptions& options,
                                        std::span<const RrmMethod> methods, std::uint32_t depth,
                                        std::uint32_t first, const RrmNote& note);

} // namespace macula::bench
