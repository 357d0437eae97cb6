// Object splits: references are divided by their centroids, at the least surface area cost.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "bvh/simd.hpp"

namespace macula::bvh {

// A set of references as the builder passes it down.
struct Subset {
    Box4 box, centroids; // centroids doubled, as Reference::centroid()

    void add(const Reference& reference) {
        box.add(reference.box());
        centroids.add(Float4(reference.centroid()));
    }
    void add(const Subset& other) {
        box.add(other.box);
        centroids.add(other.centroids);
    }
};

inline constexpr std::uint32_t kMostBins = 128;

// Maps centroids to bins, for each axis.
struct BinMapping {
    Float4 origin{}, scale{};
    std::uint32_t bins = 0;

    BinMapping() = default;
    BinMapping(const Box4& range, std::uint32_t bin_count);

    Int4 bin(Float4 point) const {
        const Float4 limit = splat(static_cast<float>(bins - 1));
        const Float4 x = min(max((point - origin) * scale, Float4{}), limit);
        return __builtin_convertvector(x, Int4);
    }
};

// Centroids in bins below `bin` of `axis` go left. cost: sum of half area * count on both sides,
// infinite when no split separates the references.
struct ObjectSplit {
    float cost = std::numeric_limits<float>::infinity();
    std::uint32_t axis = 0, bin = 0;
    BinMapping mapping;
    Box4 left, right;
    std::uint32_t left_count = 0, right_count = 0;

    bool is_valid() const { return cost < std::numeric_limits<float>::infinity(); }
    bool goes_left(const Reference& reference) const {
        return static_cast<std::uint32_t>(mapping.bin(reference.centroid())[axis]) < bin;
    }
};

// Binned over all three axes (Wald 2007, "On fast Construction of SAH-based BVHs"); fewer bins for
// small sets. The result does not depend on the order of the references or the number of threads.
ObjectSplit find_object_split(std::span<const Reference> references, const Subset& subset,
                              std::uint32_t bins);

// Exact sweep over all splits of at most kSweepSize references. Sorts them along the chosen axis
// and returns how many go left.
inline constexpr std::uint32_t kSweepSize = 4;
std::uint32_t sweep_split(std::span<Reference> references);

} // namespace macula::bvh
