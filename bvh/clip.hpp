// Clipping a triangle at axis-aligned planes. Points on a plane belong to both sides. Computed
// boxes may be off by a few units in the last place of the largest coordinate, which the margins of
// lib/triangle.h cover (docs/arithmetic.md).
#pragma once

#include "bvh/geometry.hpp"

namespace macula::bvh {

struct ClippedTriangle {
    Float4 v[3];

    ClippedTriangle(const Geometry& geometry, std::uint32_t triangle) {
        const auto& index = geometry.triangles[triangle];
        for (int i = 0; i < 3; ++i)
            v[i] = vertex(geometry, index[static_cast<std::size_t>(i)]);
    }

    // Box of the points where edges cross the plane; empty when none does.
    Box4 crossing(std::uint32_t axis, float plane) const {
        Box4 box;
        for (int i = 0; i < 3; ++i) {
            const Float4 a = v[i], b = v[i == 2 ? 0 : i + 1];
            if ((a[axis] < plane) != (b[axis] < plane)) {
                // The same point for both triangles at an edge.
                const Float4 low = a[axis] < plane ? a : b, high = a[axis] < plane ? b : a;
                const float s = (plane - low[axis]) / (high[axis] - low[axis]);
                Float4 point = low + (high - low) * splat(s);
                point[axis] = plane;
                box.add(point);
            }
        }
        return box;
    }
};

// The intersection of a reference's box and the box of the triangle's part; where rounding left
// nothing between two planes, what lies between them.
inline Box4 part_of(const Reference& reference, Box4 part) {
    part.clip(reference.box());
    return {min(part.lo, part.hi), max(part.lo, part.hi)};
}

} // namespace macula::bvh
