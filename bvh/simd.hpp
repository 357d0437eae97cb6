// Four floats at once for the builder, with the compilers' portable vector extension. The fourth
// component of a box carries data and never takes part in a decision.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

namespace macula::bvh {

using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

inline Float4 min(Float4 a, Float4 b) {
    return a < b ? a : b;
}
inline Float4 max(Float4 a, Float4 b) {
    return a > b ? a : b;
}
inline Float4 splat(float x) {
    return Float4{x, x, x, x};
}

struct Box4 {
    Float4 lo = splat(std::numeric_limits<float>::infinity());
    Float4 hi = splat(-std::numeric_limits<float>::infinity());

    void add(Float4 point) {
        lo = min(lo, point);
        hi = max(hi, point);
    }
    void add(const Box4& box) {
        lo = min(lo, box.lo);
        hi = max(hi, box.hi);
    }
    void clip(const Box4& box) {
        lo = max(lo, box.lo);
        hi = min(hi, box.hi);
    }
    // Half the surface; meaningless for an empty box.
    float half_area() const {
        const Float4 d = hi - lo;
        return d[0] * (d[1] + d[2]) + d[1] * d[2];
    }
};

// The part of a triangle's box that lies in a subtree. References start as whole triangles;
// spatial splits make several of one.
struct Reference {
    Float4 lo; // w: the triangle's margin (lib/triangle.h)
    Float4 hi; // w: the triangle's index, as bits

    Box4 box() const { return {lo, hi}; }
    Float4 centroid() const { return lo + hi; } // twice the centre
    float margin() const { return lo[3]; }
    std::uint32_t triangle() const { return std::bit_cast<std::uint32_t>(hi[3]); }
    void set_box(const Box4& box) {
        lo = Float4{box.lo[0], box.lo[1], box.lo[2], lo[3]};
        hi = Float4{box.hi[0], box.hi[1], box.hi[2], hi[3]};
    }
};

} // namespace macula::bvh
