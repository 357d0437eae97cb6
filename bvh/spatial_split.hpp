// Spatial splits (Stich et al. 2009, section 4): space is divided by a plane, and references that
// straddle it are divided too, or left whole on the side where that costs less.
#pragma once

#include <span>

#include "bvh/clip.hpp"
#include "bvh/object_split.hpp"

namespace macula::bvh {

struct SpatialSplit {
    float cost = std::numeric_limits<float>::infinity(); // as of ObjectSplit
    std::uint32_t axis = 0;
    float plane = 0.0f;
    Box4 left, right;                              // of the divided references
    std::uint32_t left_count = 0, right_count = 0; // divided references count on both sides

    bool is_valid() const { return cost < std::numeric_limits<float>::infinity(); }

    enum class Side : std::uint8_t { left, right, both };
    // `both` only where dividing is cheaper than either side (reference unsplitting, section 4.4).
    Side side(const Reference& reference) const;
};

// Binned over all three axes, with triangles chopped exactly at the bins' borders.
SpatialSplit find_spatial_split(std::span<const Reference> references, const Box4& box,
                                const Geometry& geometry, std::uint32_t bins);

struct Divided {
    Reference left, right;
};
Divided divide(const Reference& reference, const SpatialSplit& split, const Geometry& geometry);

} // namespace macula::bvh
