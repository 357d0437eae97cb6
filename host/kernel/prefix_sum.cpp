#include "host/kernel/prefix_sum.hpp"

#include <algorithm>

namespace macula::kernel {
namespace {

/// MACULA_WORK_GROUP of kernels/scan/scan.cl, and its ITEMS.
constexpr std::uint32_t kWorkGroup = 128;
constexpr std::uint32_t kItems = 16;
constexpr std::uint32_t kTile = kWorkGroup * kItems;

VariantKey scan_key() {
    return VariantKey("scan/scan").parameter("work_group", kWorkGroup);
}

std::uint64_t tiles_of(std::uint64_t elements) {
    return (elements + kTile - 1) / kTile;
}

std::uint64_t checked_capacity(std::uint64_t capacity) {
    if (capacity > PrefixSum::kMaxCapacity)
        throw compute::Error("a prefix sum of " + std::to_string(capacity) +
                             " elements: the most is " + std::to_string(PrefixSum::kMaxCapacity));
    return capacity;
}

void require_room(const compute::Buffer& buffer, std::uint64_t elements) {
    if (buffer.count<std::uint32_t>() < elements)
        throw compute::Error("prefix sum over " + std::to_string(elements) +
                             " elements: buffer \"" + buffer.what() + "\" holds only " +
                             std::to_string(buffer.count<std::uint32_t>()));
}

} // namespace

PrefixSum::PrefixSum(Library& library, const compute::Device& device, std::uint64_t capacity)
    : capacity_(checked_capacity(capacity)),
      sum_tiles_(library.kernel(scan_key(), "sum_tiles", device)),
      scan_tiles_(library.kernel(scan_key(), "scan_tiles", device)),
      scan_top_(library.kernel(scan_key(), "scan_top", device)) {
    std::uint64_t n = capacity_;
    do {
        n = tiles_of(n);
        sums_.push_back(device.allocate_array<std::uint32_t>(n, "prefix sum of tiles"));
    } while (n > kTile);
}

const compute::Buffer& PrefixSum::tile_offsets(const compute::Buffer& values,
                                               const compute::Buffer& count,
                                               const compute::Buffer& total,
                                               const std::string& stage, std::uint64_t at_most) {
    require_room(values, capacity_);
    if (total.state() == count.state())
        throw compute::Error("prefix sum: the total would overwrite the count that it still needs");
    const auto capacity = static_cast<std::uint32_t>(std::min(capacity_, at_most));
    const auto top = static_cast<std::uint32_t>(sums_.size());
    const auto input = [&](std::uint32_t level) { return level == 0 ? values : sums_[level - 1]; };
    const auto launch = [&](compute::Kernel& kernel, std::uint64_t tiles) {
        kernel.launch(stage, {static_cast<std::size_t>(tiles) * kWorkGroup}, {kWorkGroup});
    };
    std::vector<std::uint64_t> tiles;
    std::uint64_t n = capacity;
    for (std::uint32_t level = 0; level < top; ++level) {
        n = tiles_of(n);
        tiles.push_back(n);
        launch(sum_tiles_.set(input(level), count, capacity, level, sums_[level]), n);
    }
    launch(scan_top_.set(input(top), count, capacity, top, input(top), total), 1);
    for (std::uint32_t level = top; level-- > 1;)
        launch(scan_tiles_.set(input(level), count, capacity, level, sums_[level], input(level)),
               tiles[level]);
    return sums_.front();
}

void PrefixSum::exclusive(const compute::Buffer& values, const compute::Buffer& count,
                          const compute::Buffer& offsets, const compute::Buffer& total,
                          const std::string& stage) {
    require_room(offsets, capacity_);
    const compute::Buffer& before = tile_offsets(values, count, total, stage);
    scan_tiles_.set(values, count, static_cast<std::uint32_t>(capacity_), 0U, before, offsets)
        .launch(stage, {compute::Range::cover(capacity_, kTile) / kItems}, {kWorkGroup});
}

Compaction::Compaction(Library& library, const compute::Device& device, std::uint64_t capacity)
    : sum_(library, device, capacity),
      compact_(library.kernel(scan_key(), "compact_tiles", device)) {}

void Compaction::run(const compute::Buffer& flags, const compute::Buffer& count,
                     const compute::Buffer& indices, const compute::Buffer& total,
                     const std::string& stage, std::uint64_t at_most) {
    const compute::Buffer& before = sum_.tile_offsets(flags, count, total, stage, at_most);
    const auto capacity = static_cast<std::uint32_t>(std::min(sum_.capacity(), at_most));
    compact_.set(flags, count, capacity, before, indices)
        .launch(stage, {compute::Range::cover(capacity, kTile) / kItems}, {kWorkGroup});
}

} // namespace macula::kernel
