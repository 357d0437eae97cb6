#include "bvh/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include "lib/triangle.h"

namespace macula::bvh {
namespace {

constexpr float kLargestCoordinate = 1e18f;
constexpr std::size_t kGrain = 8192;

bool is_valid(float x) {
    return std::fabs(x) < kLargestCoordinate; // false for NaN
}

// The least index in [0, count) for which `is_bad` holds, or count.
template <typename Predicate>
std::size_t first_bad(std::size_t count, const Predicate& is_bad) {
    return tbb::parallel_reduce(
        tbb::blocked_range<std::size_t>(0, count, kGrain), count,
        [&](const tbb::blocked_range<std::size_t>& range, std::size_t first) {
            for (std::size_t i = range.begin(); i < range.end() && i < first; ++i) {
                if (is_bad(i))
                    return i;
            }
            return first;
        },
        [](std::size_t a, std::size_t b) { return std::min(a, b); });
}

void validate(const Geometry& geometry) {
    const auto fail = [](const std::string& what) {
        throw std::invalid_argument("BVH build: " + what);
    };
    if (geometry.positions.size() % 3 != 0)
        fail("positions hold " + std::to_string(geometry.positions.size()) +
             " floats, which is not a multiple of 3");
    if (!geometry.masked.empty() && geometry.masked.size() != geometry.triangles.size())
        fail("masked has " + std::to_string(geometry.masked.size()) + " entries for " +
             std::to_string(geometry.triangles.size()) + " triangles");
    const std::size_t vertices = geometry.positions.size() / 3;
    const std::size_t triangle = first_bad(geometry.triangles.size(), [&](std::size_t i) {
        const auto& t = geometry.triangles[i];
        return t[0] >= vertices || t[1] >= vertices || t[2] >= vertices;
    });
    if (triangle < geometry.triangles.size()) {
        const auto& t = geometry.triangles[triangle];
        fail("triangle " + std::to_string(triangle) + " uses vertex " +
             std::to_string(std::max({t[0], t[1], t[2]})) + ", but there are only " +
             std::to_string(vertices));
    }
    const std::size_t bad = first_bad(
        geometry.positions.size(), [&](std::size_t i) { return !is_valid(geometry.positions[i]); });
    if (bad < geometry.positions.size())
        fail("coordinate " + std::string(1, "xyz"[bad % 3]) + " of vertex " +
             std::to_string(bad / 3) + " is " + std::to_string(geometry.positions[bad]) +
             "; coordinates must be finite and below 1e18 in size");
}

Reference make_reference(const Geometry& geometry, std::uint32_t triangle) {
    Box4 box;
    for (const std::uint32_t index : geometry.triangles[triangle])
        box.add(vertex(geometry, index));
    const float margin =
        shared::triangle_margin(box.lo[0], box.lo[1], box.lo[2], box.hi[0], box.hi[1], box.hi[2]);
    box.lo[3] = margin;
    box.hi[3] = std::bit_cast<float>(triangle);
    return {box.lo, box.hi};
}

} // namespace

ReferenceSet make_references(const Geometry& geometry, std::size_t capacity) {
    validate(geometry);
    struct Boxes {
        Box4 box, centroids;
    };
    ReferenceSet set;
    set.count = static_cast<std::uint32_t>(geometry.triangles.size());
    set.references = std::make_unique_for_overwrite<Reference[]>(capacity);
    const Boxes boxes = tbb::parallel_reduce(
        tbb::blocked_range<std::uint32_t>(0, set.count, kGrain), Boxes{},
        [&](const tbb::blocked_range<std::uint32_t>& range, Boxes sum) {
            for (std::uint32_t i = range.begin(); i < range.end(); ++i) {
                const Reference reference = make_reference(geometry, i);
                set.references[i] = reference;
                sum.box.add(reference.box());
                sum.centroids.add(reference.centroid());
            }
            return sum;
        },
        [](Boxes a, const Boxes& b) {
            a.box.add(b.box);
            a.centroids.add(b.centroids);
            return a;
        });
    set.box = boxes.box;
    set.centroids = boxes.centroids;
    return set;
}

} // namespace macula::bvh
