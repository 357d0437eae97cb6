// The stages of a foveated frame in the columns of Table 1 of Weier et al. 2016.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "host/frame/timings.hpp"

namespace macula::bench {

enum class StageGroup : std::uint8_t { reproject, ray_tracing, cache_update, merge, post };
inline constexpr std::size_t kStageGroups = 5;
// As they are called in JSON: reproject, ray_tracing, cache_update, merge, post.
const char* name(StageGroup group);

// Of a stage of methods `full` and `weier`. The choice of pixels counts as reprojection (both are
// block 1 of the paper's figure 2), not as ray tracing, since a full frame does without it. Throws
// std::invalid_argument for a stage that is not in the table.
StageGroup group_of(std::string_view stage);

// Milliseconds of each group by the device's clock.
std::array<double, kStageGroups> sum_by_group(std::span<const frame::StageTime> stages);

} // namespace macula::bench
