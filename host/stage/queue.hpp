// Queues of secondary rays, worked off in batches of bounded memory (kernels/shade/queue.h).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "host/stage/kit.hpp"

namespace macula::stage {

// At most this many rays are in memory at a time: 32 MiB of rays and 4 MiB of results, whatever the
// image's size. Large enough that a batch's launches cost under 1 % of its tracing, and a batch is
// one stretch of the image, so that its rays find the scene's nodes in the cache.
inline constexpr std::uint32_t kBatchRays = 1u << 20;

// Entries of a batch whose entries have `samples` rays each: a multiple of 64, at most
// the slots that this frame's launches cover.
std::uint32_t batch_entries(const Kit& kit, std::uint32_t samples);

// "queue flags", "queue", "queue count", "queued rays", "queued ray count" and "occluded", shared
// by the stages that trace secondary rays.
std::vector<frame::Resource> queue_scratch(const Kit& kit, std::uint32_t samples);

// Calls `batch(first)` for first = 0, entries, 2 * entries, .. until all slots are covered. How
// many entries there really are is known to the device only; the batches beyond return at once.
void for_each_batch(const Kit& kit, std::uint32_t entries,
                    const std::function<void(std::uint32_t first)>& batch);

} // namespace macula::stage
