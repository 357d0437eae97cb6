#include "bench/stage_groups.hpp"

#include <stdexcept>
#include <string>

namespace macula::bench {
namespace {

struct Entry {
    std::string_view stage; // or how its name begins
    StageGroup group;
};

constexpr std::array kEntries = {
    Entry{"project the support mesh", StageGroup::reproject},
    Entry{"detect errors and draw the mesh", StageGroup::reproject},
    Entry{"judge the history", StageGroup::reproject},
    Entry{"choose pixels", StageGroup::reproject},
    Entry{"choose blocks", StageGroup::reproject},
    Entry{"plan the refresh", StageGroup::reproject},
    Entry{"order the list", StageGroup::reproject},
    Entry{"generate ", StageGroup::ray_tracing},
    Entry{"trace ", StageGroup::ray_tracing},
    Entry{"resolve surfaces", StageGroup::ray_tracing},
    Entry{"flag ", StageGroup::ray_tracing},
    Entry{"queue ", StageGroup::ray_tracing},
    Entry{"add light", StageGroup::ray_tracing},
    Entry{"shade", StageGroup::ray_tracing},
    Entry{"bounce ", StageGroup::ray_tracing},
    Entry{"find layers", StageGroup::ray_tracing},
    Entry{"collect layers", StageGroup::ray_tracing},
    Entry{"weigh layers", StageGroup::ray_tracing},
    Entry{"list layers", StageGroup::ray_tracing},
    Entry{"layer ", StageGroup::ray_tracing},
    Entry{"blend layers", StageGroup::ray_tracing},
    Entry{"average ", StageGroup::ray_tracing},
    Entry{"keep the first ", StageGroup::ray_tracing},
    Entry{"extract the support image and G-buffer", StageGroup::cache_update},
    Entry{"measure the history's lag", StageGroup::cache_update},
    Entry{"find what changed", StageGroup::cache_update},
    Entry{"update and merge the cache", StageGroup::merge},
    Entry{"post-process", StageGroup::post},
    Entry{"place ", StageGroup::merge},
    Entry{"follow surfaces", StageGroup::post},
    Entry{"smooth over frames", StageGroup::post},
    Entry{"split colour", StageGroup::post},
    Entry{"upscale", StageGroup::post},
    Entry{"sharpen", StageGroup::post},
    Entry{"remap", StageGroup::merge},
    Entry{"blur the rings", StageGroup::merge},
    Entry{"summarise texels", StageGroup::merge},
};

} // namespace

const char* name(StageGroup group) {
    constexpr std::array<const char*, kStageGroups> names = {"reproject", "ray_tracing",
                                                             "cache_update", "merge", "post"};
    return names[static_cast<std::size_t>(group)];
}

StageGroup group_of(std::string_view stage) {
    for (const Entry& entry : kEntries) {
        if (stage.starts_with(entry.stage))
            return entry.group;
    }
    throw std::invalid_argument("stage \"" + std::string(stage) +
                                "\" has no column in bench/stage_groups.cpp");
}

std::array<double, kStageGroups> sum_by_group(std::span<const frame::StageTime> stages) {
    std::array<double, kStageGroups> ms{};
    for (const frame::StageTime& stage : stages)
        ms[static_cast<std::size_t>(group_of(stage.stage))] += stage.device_ms;
    return ms;
}

} // namespace macula::bench
