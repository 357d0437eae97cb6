// In-place partition of references, serial or parallel. The order that results depends on the
// references and the predicate alone, never on the number of threads.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include <tbb/parallel_for.h>

#include "bvh/object_split.hpp"

namespace macula::bvh {

struct Partition {
    std::uint32_t left_count = 0;
    Subset left, right;
};

template <typename Predicate>
Partition partition_serially(std::span<Reference> references, const Predicate& goes_left) {
    Partition result;
    std::size_t begin = 0, end = references.size();
    while (true) {
        while (begin < end && goes_left(references[begin]))
            result.left.add(references[begin++]);
        while (begin < end && !goes_left(references[end - 1]))
            result.right.add(references[--end]);
        if (begin == end)
            break;
        std::swap(references[begin], references[end - 1]);
    }
    result.left_count = static_cast<std::uint32_t>(begin);
    return result;
}

// Blocks of a fixed number are partitioned each for itself; then what lies on the wrong side of
// the common border changes places, in order.
template <typename Predicate>
Partition partition(std::span<Reference> references, const Predicate& goes_left) {
    constexpr std::size_t kParallelSize = 32768, kBlocks = 16;
    if (references.size() < kParallelSize)
        return partition_serially(references, goes_left);
    const auto block_begin = [&](std::size_t i) { return references.size() * i / kBlocks; };
    std::array<Partition, kBlocks> parts;
    tbb::parallel_for(std::size_t{0}, kBlocks, [&](std::size_t i) {
        parts[i] = partition_serially(
            references.subspan(block_begin(i), block_begin(i + 1) - block_begin(i)), goes_left);
    });
    Partition result;
    for (const Partition& part : parts) {
        result.left_count += part.left_count;
        result.left.add(part.left);
        result.right.add(part.right);
    }
    const std::size_t border = result.left_count;
    std::size_t from_block = 0, from = 0; // the next right reference left of the border
    std::size_t to_block = 0, to = 0;     // the next left reference right of the border
    const auto right_begin = [&](std::size_t i) { return block_begin(i) + parts[i].left_count; };
    while (true) {
        while (from_block < kBlocks &&
               std::max(from, right_begin(from_block)) >= block_begin(from_block + 1))
            ++from_block;
        while (to_block < kBlocks &&
               std::max({to, block_begin(to_block), border}) >= right_begin(to_block))
            ++to_block;
        if (from_block == kBlocks || to_block == kBlocks)
            break;
        from = std::max(from, right_begin(from_block));
        to = std::max({to, block_begin(to_block), border});
        if (from >= border)
            break;
        const std::size_t count = std::min(
            {block_begin(from_block + 1) - from, right_begin(to_block) - to, border - from});
        std::swap_ranges(references.begin() + static_cast<std::ptrdiff_t>(from),
                         references.begin() + static_cast<std::ptrdiff_t>(from + count),
                         references.begin() + static_cast<std::ptrdiff_t>(to));
        from += count;
        to += count;
    }
    return result;
}

} // namespace macula::bvh
