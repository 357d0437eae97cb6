// Validation of a mesh and the references it starts with.
#pragma once

#include <memory>

#include "bvh/bvh.hpp"
#include "bvh/simd.hpp"

namespace macula::bvh {

struct ReferenceSet {
    std::unique_ptr<Reference[]> references; // one a triangle, in order, and spare room behind
    std::uint32_t count = 0;
    Box4 box, centroids; // centroids doubled, as Reference::centroid()
};

// Throws std::invalid_argument where bvh::build() does. `capacity` >= the number of triangles.
ReferenceSet make_references(const Geometry& geometry, std::size_t capacity);

inline Float4 vertex(const Geometry& geometry, std::uint32_t index) {
    const float* p = geometry.positions.data() + std::size_t{3} * index;
    return Float4{p[0], p[1], p[2], 0.0f};
}

} // namespace macula::bvh
