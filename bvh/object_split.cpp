#include "bvh/object_split.hpp"

#include <algorithm>
#include <array>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

namespace macula::bvh {
namespace {

constexpr std::size_t kParallelSize = 32768;
constexpr std::size_t kGrain = 8192;
constexpr float kNoCost = std::numeric_limits<float>::infinity();

template <std::size_t Most>
struct Bins {
    std::array<std::array<Box4, Most>, 3> box;
    std::array<std::array<std::uint32_t, Most>, 3> count;

    explicit Bins(std::uint32_t bins) {
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            std::fill_n(box[axis].begin(), bins, Box4{});
            std::fill_n(count[axis].begin(), bins, 0u);
        }
    }
    void add(std::span<const Reference> references, const BinMapping& mapping) {
        for (const Reference& reference : references) {
            const Int4 bin = mapping.bin(reference.centroid());
            for (std::uint32_t axis = 0; axis < 3; ++axis) {
                const auto i = static_cast<std::uint32_t>(bin[axis]);
                box[axis][i].add(reference.box());
                ++count[axis][i];
            }
        }
    }
    void add(const Bins& other, std::uint32_t bins) {
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            for (std::uint32_t i = 0; i < bins; ++i) {
                box[axis][i].add(other.box[axis][i]);
                count[axis][i] += other.count[axis][i];
            }
        }
    }
};

// Half area * count of all bins from i on, for each i.
template <std::size_t Most>
void sweep_from_right(const Bins<Most>& bins, std::uint32_t axis, std::uint32_t size,
                      std::array<float, Most>& cost) {
    Box4 box;
    std::uint32_t count = 0;
    for (std::uint32_t i = size; i-- > 1;) {
        box.add(bins.box[axis][i]);
        count += bins.count[axis][i];
        cost[i] = count == 0 ? kNoCost : box.half_area() * static_cast<float>(count);
    }
}

template <std::size_t Most>
ObjectSplit best_split(const Bins<Most>& bins, const BinMapping& mapping) {
    ObjectSplit best;
    best.mapping = mapping;
    std::array<float, Most> right_cost;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
        if (mapping.scale[axis] == 0.0f)
            continue;
        sweep_from_right(bins, axis, mapping.bins, right_cost);
        Box4 box;
        std::uint32_t count = 0;
        for (std::uint32_t i = 1; i < mapping.bins; ++i) {
            box.add(bins.box[axis][i - 1]);
            count += bins.count[axis][i - 1];
            const float cost =
                count == 0 ? kNoCost : box.half_area() * static_cast<float>(count) + right_cost[i];
            if (cost < best.cost) {
                best.cost = cost;
                best.axis = axis;
                best.bin = i;
            }
        }
    }
    if (best.is_valid()) {
        for (std::uint32_t i = 0; i < mapping.bins; ++i) {
            (i < best.bin ? best.left : best.right).add(bins.box[best.axis][i]);
            (i < best.bin ? best.left_count : best.right_count) += bins.count[best.axis][i];
        }
    }
    return best;
}

template <std::size_t Most>
ObjectSplit find(std::span<const Reference> references, const BinMapping& mapping) {
    if (references.size() < kParallelSize) {
        Bins<Most> bins(mapping.bins);
        bins.add(references, mapping);
        return best_split(bins, mapping);
    }
    const Bins<Most> bins = tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, references.size(), kGrain), Bins<Most>(mapping.bins),
        [&](const tbb::blocked_range<std::size_t>& range, Bins<Most> sum) {
            sum.add(references.subspan(range.begin(), range.size()), mapping);
            return sum;
        },
        [&](Bins<Most> a, const Bins<Most>& b) {
            a.add(b, mapping.bins);
            return a;
        });
    return best_split(bins, mapping);
}

using Order = std::array<std::uint8_t, kSweepSize>;

Order sort_along(std::span<const Reference> references, std::uint32_t axis) {
    Order order{};
    std::array<float, kSweepSize> key{};
    for (std::uint32_t i = 0; i < references.size(); ++i) {
        const float k = references[i].centroid()[axis];
        std::uint32_t place = i;
        for (; place > 0 && key[place - 1] > k; --place) {
            key[place] = key[place - 1];
            order[place] = order[place - 1];
        }
        key[place] = k;
        order[place] = static_cast<std::uint8_t>(i);
    }
    return order;
}

} // namespace

BinMapping::BinMapping(const Box4& range, std::uint32_t bin_count) : bins(bin_count) {
    const Float4 extent = range.hi - range.lo;
    origin = Float4{range.lo[0], range.lo[1], range.lo[2], 0.0f};
    for (int axis = 0; axis < 3; ++axis)
        scale[axis] =
            extent[axis] > 1e-30f ? static_cast<float>(bins) * 0.9999f / extent[axis] : 0.0f;
}

ObjectSplit find_object_split(std::span<const Reference> references, const Subset& subset,
                              std::uint32_t bins) {
    const std::size_t useful = 4 + references.size() / 16;
    const BinMapping mapping(subset.centroids,
                             static_cast<std::uint32_t>(std::min<std::size_t>(bins, useful)));
    return mapping.bins <= 32 ? find<32>(references, mapping)
                              : find<kMostBins>(references, mapping);
}

std::uint32_t sweep_split(std::span<Reference> references) {
    const auto size = static_cast<std::uint32_t>(references.size());
    float best_cost = kNoCost;
    std::uint32_t best_left = size / 2;
    Order best_order{};
    for (std::uint32_t i = 0; i < size; ++i)
        best_order[i] = static_cast<std::uint8_t>(i);
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
        const Order order = sort_along(references, axis);
        std::array<float, kSweepSize> right_cost{};
        Box4 box;
        for (std::uint32_t i = size; i-- > 1;) {
            box.add(references[order[i]].box());
            right_cost[i] = box.half_area() * static_cast<float>(size - i);
        }
        box = Box4{};
        for (std::uint32_t i = 1; i < size; ++i) {
            box.add(references[order[i - 1]].box());
            const float cost = box.half_area() * static_cast<float>(i) + right_cost[i];
            if (cost < best_cost) {
                best_cost = cost;
                best_left = i;
                best_order = order;
            }
        }
    }
    std::array<Reference, kSweepSize> sorted;
    for (std::uint32_t i = 0; i < size; ++i)
        sorted[i] = references[best_order[i]];
    std::copy_n(sorted.begin(), size, references.begin());
    return best_left;
}

} // namespace macula::bvh
