// The error bound behind spatial splits (docs/arithmetic.md, "Parts of triangles"): a triangle is
// divided at random planes, and every ray that hits it must enter the widened box of some part no
// later than at the hit's t. Rays are aimed at what is hardest: split planes, vertices, edges.
#include <gtest/gtest.h>

#include "bvh/spatial_split.hpp"
#include "tests/support/bvh_scenes.hpp"

namespace macula::bvh::test {
namespace {

using Point = std::array<float, 3>;

struct Shape {
    float size = 1.0f;     // of the triangle
    float thinness = 1.0f; // of its third vertex's distance from an edge
    float offset = 0.0f;   // from the coordinates' origin
    float reach = 2.0f;    // of ray origins around the triangle
};

Soup make_triangle(const Shape& shape, Random& random) {
    std::array<float, 9> p{};
    for (std::size_t i = 0; i < 3; ++i) {
        p[i] = shape.offset + random(-1, 1) * shape.size;
        p[3 + i] = shape.offset + random(-1, 1) * shape.size;
        p[6 + i] = p[i] + random(-1, 1) * shape.size * shape.thinness;
    }
    // Many real triangles lie in a plane of the axes.
    if (random.below(4) == 0) {
        const std::size_t axis = random.below(3);
        p[3 + axis] = p[6 + axis] = p[axis];
    }
    Soup soup;
    soup.add(p);
    return soup;
}

struct Parts {
    std::vector<Reference> references;
    std::vector<SpatialSplit> splits;
};

// Divides the triangle at up to `count` random planes through its parts.
Parts divide_at_random(const Soup& soup, int count, Random& random) {
    const Geometry geometry = soup.geometry();
    Parts parts;
    parts.references.push_back(make_references(geometry, 1).references[0]);
    for (int i = 0; i < count; ++i) {
        const std::size_t which = random.below(static_cast<std::uint32_t>(parts.references.size()));
        const Reference reference = parts.references[which];
        SpatialSplit split;
        split.axis = random.below(3);
        const float lo = reference.lo[split.axis], hi = reference.hi[split.axis];
        split.plane = random(lo, hi);
        if (!(split.plane > lo && split.plane < hi))
            continue;
        const Divided halves = divide(reference, split, geometry);
        parts.references[which] = halves.left;
        parts.references.push_back(halves.right);
        parts.splits.push_back(split);
    }
    return parts;
}

Point target_on(const Soup& soup, const Parts& parts, Random& random) {
    const float* p = soup.positions.data();
    const auto vertex_at = [&](std::uint32_t i) {
        return Point{p[3 * i], p[3 * i + 1], p[3 * i + 2]};
    };
    const auto between = [](const Point& a, const Point& b, float s) {
        return Point{a[0] + (b[0] - a[0]) * s, a[1] + (b[1] - a[1]) * s, a[2] + (b[2] - a[2]) * s};
    };
    const std::uint32_t first = random.below(3);
    const Point a = vertex_at(first), b = vertex_at((first + 1) % 3),
                c = vertex_at((first + 2) % 3);
    const Point on_edge = between(a, b, random(0, 1));
    switch (random.below(4)) {
    case 0:
        return a;
    case 1:
        return on_edge;
    case 2:
        return between(on_edge, c, random(0, 1));
    default:
        break;
    }
    if (parts.splits.empty())
        return on_edge;
    const SpatialSplit& split =
        parts.splits[random.below(static_cast<std::uint32_t>(parts.splits.size()))];
    const Point other = random.below(2) == 0 ? c : between(a, c, random(0, 1));
    const float from = on_edge[split.axis], to = other[split.axis];
    Point target = between(on_edge, other, (split.plane - from) / (to - from));
    target[split.axis] = split.plane;
    return (from < split.plane) != (to < split.plane) ? target : on_edge;
}

Ray aim(const Shape& shape, const Point& target, Random& random) {
    Point origin{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        origin[axis] = shape.offset + random(-shape.reach, shape.reach);
        if (random.below(8) == 0)
            origin[axis] = target[axis]; // a zero component of the direction
    }
    return ray_between(origin, target);
}

bool enters_a_part(const shared::TraceRay& ray, const Parts& parts, float t) {
    for (const Reference& part : parts.references) {
        const float m = part.margin();
        float near, far;
        shared::box_interval(&ray, part.lo[0] - m, part.lo[1] - m, part.lo[2] - m, part.hi[0] + m,
                             part.hi[1] + m, part.hi[2] + m, &near, &far);
        if (near <= far && near <= t)
            return true;
    }
    return false;
}

void expect_hits_enter_parts(const Shape& shape, std::uint32_t seed) {
    constexpr int kTriangles = 5000, kRays = 400;
    Random random(seed);
    int hits = 0, lost = 0;
    for (int i = 0; i < kTriangles; ++i) {
        const Soup soup = make_triangle(shape, random);
        const Parts parts = divide_at_random(soup, 12, random);
        const float* p = soup.positions.data();
        for (int k = 0; k < kRays; ++k) {
            const Ray ray = aim(shape, target_on(soup, parts, random), random);
            const shared::TraceRay r = shared::make_trace_ray(
                ray.origin[0], ray.origin[1], ray.origin[2], ray.direction[0], ray.direction[1],
                ray.direction[2], ray.t_min, ray.t_max);
            float t, u, v;
            if (!shared::intersect_triangle(&r, p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7],
                                            p[8], &t, &u, &v))
                continue;
            ++hits;
            lost += enters_a_part(r, parts, t) ? 0 : 1;
        }
    }
    EXPECT_EQ(lost, 0);
    EXPECT_GT(hits, kTriangles * kRays / 50);
}

TEST(BvhParts, OrdinaryTriangles) {
    expect_hits_enter_parts({1.0f, 1.0f, 0.0f, 2.0f}, 1);
}
TEST(BvhParts, Needles) {
    expect_hits_enter_parts({1.0f, 1e-3f, 0.0f, 2.0f}, 2);
}
TEST(BvhParts, AlmostDegenerate) {
    expect_hits_enter_parts({1.0f, 1e-7f, 0.0f, 2.0f}, 3);
}
TEST(BvhParts, OriginsInTheCentre) {
    expect_hits_enter_parts({1.0f, 1e-2f, 0.0f, 1e-6f}, 4);
}
TEST(BvhParts, OriginsFarAway) {
    expect_hits_enter_parts({1.0f, 0.1f, 0.0f, 1e4f}, 5);
}
TEST(BvhParts, OriginsBeyondAllResolution) {
    expect_hits_enter_parts({1.0f, 0.5f, 0.0f, 1e8f}, 6);
}
TEST(BvhParts, FarFromTheCoordinatesOrigin) {
    expect_hits_enter_parts({1.0f, 0.1f, 1000.0f, 2.0f}, 7);
}
TEST(BvhParts, VeryFarFromTheCoordinatesOrigin) {
    expect_hits_enter_parts({1.0f, 0.5f, 1e5f, 5.0f}, 8);
}
TEST(BvhParts, LongTrianglesSeenFromNearby) {
    expect_hits_enter_parts({1000.0f, 1e-3f, 0.0f, 1.0f}, 9);
}
TEST(BvhParts, Tiny) {
    expect_hits_enter_parts({1e-5f, 0.1f, 0.0f, 1e-4f}, 10);
}
TEST(BvhParts, Huge) {
    expect_hits_enter_parts({1e9f, 0.1f, 0.0f, 2e9f}, 11);
}

} // namespace
} // namespace macula::bvh::test
