#include "host/stage/queue.hpp"

#include <algorithm>

#include "shared/ray.h"

namespace macula::stage {

namespace {

std::uint32_t fitting_entries(std::uint32_t samples) {
    constexpr auto group = static_cast<std::uint32_t>(kGroup);
    return std::max(kBatchRays / samples / group, 1u) * group;
}

} // namespace

std::uint32_t batch_entries(const Kit& kit, std::uint32_t samples) {
    return std::min(fitting_entries(samples), kit.launched());
}

std::vector<frame::Resource> queue_scratch(const Kit& kit, std::uint32_t samples) {
    const std::uint64_t rays =
        std::uint64_t{std::min(fitting_entries(samples), kit.slots())} * samples;
    return {
        per_slot(kit, "queue flags", 4),
        per_slot(kit, "queue", 4),
        {"queue count", 4, 1},
        {"queued rays", sizeof(shared::RayBlock), rays / MACULA_RAY_BLOCK},
        {"queued ray count", 4, 1},
        {"occluded", 4, rays},
    };
}

void for_each_batch(const Kit& kit, std::uint32_t entries,
                    const std::function<void(std::uint32_t first)>& batch) {
    for (std::uint32_t first = 0; first < kit.launched(); first += entries)
        batch(first);
}

} // namespace macula::stage
