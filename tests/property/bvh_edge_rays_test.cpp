// Rays that tree walks and triangle tests get wrong: each by name, tree against brute force.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/bvh_scenes.hpp"

namespace macula::bvh::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// A floor of n x n quads in the plane y = 0, at integer coordinates from -n / 2.
Soup floor_of_quads(int n) {
    Soup soup;
    for (int z = 0; z <= n; ++z) {
        for (int x = 0; x <= n; ++x)
            soup.add_vertex(static_cast<float>(x - n / 2), 0, static_cast<float>(z - n / 2));
    }
    const auto index = [&](int x, int z) { return static_cast<std::uint32_t>(z * (n + 1) + x); };
    for (int z = 0; z < n; ++z) {
        for (int x = 0; x < n; ++x) {
            soup.triangles.push_back({index(x, z), index(x + 1, z), index(x, z + 1)});
            soup.triangles.push_back({index(x + 1, z), index(x + 1, z + 1), index(x, z + 1)});
        }
    }
    return soup;
}

shared::TraceHit expect_agreement(const OneMesh& mesh, const Ray& ray) {
    const shared::TraceHit brute = mesh.by_brute_force(ray), tree = mesh.by_tree(ray);
    EXPECT_TRUE(same_bits(tree, brute)) << tree.t << " against " << brute.t;
    return brute;
}

TEST(BvhEdgeRays, InAFloorsPlane) {
    const Soup soup = floor_of_quads(16);
    const OneMesh mesh(soup.geometry());
    Random random(1);
    for (int i = 0; i < 2000; ++i)
        expect_agreement(mesh, ray_between({random(-20, 20), 0, random(-20, 20)},
                                           {random(-8, 8), 0, random(-8, 8)}));
}

// The floor is closed: no ray from above slips through an edge or a vertex.
TEST(BvhEdgeRays, ThroughInnerEdgesAndVertices) {
    const Soup soup = floor_of_quads(16);
    const OneMesh mesh(soup.geometry());
    Random random(2);
    const auto inner = [&] { return static_cast<float>(static_cast<int>(random.below(15)) - 7); };
    for (int i = 0; i < 20000; ++i) {
        const std::array<float, 3> from = {random(-9, 9), random(0.001f, 9), random(-9, 9)};
        const std::array<float, 3> to = {inner(), 0, i % 2 == 0 ? inner() : random(-7, 7)};
        const shared::TraceHit hit = expect_agreement(mesh, ray_between(from, to));
        EXPECT_NE(hit.triangle, MACULA_NO_TRIANGLE) << "a leak";
    }
}

TEST(BvhEdgeRays, ThroughEdgesOfAFloorFarBelow) {
    Soup soup = floor_of_quads(16);
    for (std::size_t i = 1; i < soup.positions.size(); i += 3)
        soup.positions[i] = -1000.0f;
    const OneMesh mesh(soup.geometry());
    Random random(3);
    for (int i = 0; i < 20000; ++i) {
        const float edge = static_cast<float>(static_cast<int>(random.below(15)) - 7);
        const shared::TraceHit hit =
            expect_agreement(mesh, ray_between({0, 0, 0}, {edge, -1000.0f, random(-7, 7)}));
        EXPECT_NE(hit.triangle, MACULA_NO_TRIANGLE) << "a leak";
    }
}

TEST(BvhEdgeRays, ZeroDirectionComponents) {
    const Soup soup = floor_of_quads(16);
    const OneMesh mesh(soup.geometry());
    Random random(4);
    for (int i = 0; i < 2000; ++i) {
        Ray ray = ray_between({random(-7, 7), random(-2, 2), random(-7, 7)}, {0, 0, 0});
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (random.below(2) == 0)
                ray.direction[axis] = random.below(2) == 0 ? 0.0f : -0.0f;
        }
        expect_agreement(mesh, ray);
    }
    Ray down = ray_between({0.5f, 3, 0.5f}, {0.5f, 0, 0.5f});
    down.direction[0] = -0.0f;
    const shared::TraceHit hit = expect_agreement(mesh, down);
    EXPECT_NEAR(hit.t, 1.0f, 1e-5f);
}

TEST(BvhEdgeRays, FromAPointOnTheSurface) {
    const Soup soup = floor_of_quads(8);
    const OneMesh mesh(soup.geometry());
    const Ray ray = ray_between({0.25f, 0, 0.25f}, {0.25f, 1, 0.25f});
    const shared::TraceHit hit = expect_agreement(mesh, ray);
    EXPECT_EQ(hit.t, 0.0f);
    Ray later = ray;
    later.t_min = 1e-4f;
    EXPECT_EQ(expect_agreement(mesh, later).triangle, MACULA_NO_TRIANGLE);
}

TEST(BvhEdgeRays, BothEndsOfTheIntervalCount) {
    const Soup soup = floor_of_quads(8);
    const OneMesh mesh(soup.geometry());
    Ray ray = ray_between({0.25f, 2, 0.25f}, {0.25f, 0, 0.25f});
    const float t = expect_agreement(mesh, ray).t;
    ray.t_max = t;
    EXPECT_NE(expect_agreement(mesh, ray).triangle, MACULA_NO_TRIANGLE);
    ray.t_max = std::nextafter(t, 0.0f);
    const shared::TraceHit miss = expect_agreement(mesh, ray);
    EXPECT_EQ(miss.triangle, MACULA_NO_TRIANGLE);
    EXPECT_EQ(miss.t, ray.t_max);
}

TEST(BvhEdgeRays, NanRaysMiss) {
    const Soup soup = floor_of_quads(8);
    const OneMesh mesh(soup.geometry());
    const Ray good = ray_between({0.25f, 2, 0.25f}, {0.25f, 0, 0.25f});
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Ray ray = good;
        ray.origin[axis] = kNan;
        EXPECT_EQ(mesh.by_tree(ray).triangle, MACULA_NO_TRIANGLE);
        EXPECT_EQ(mesh.by_brute_force(ray).triangle, MACULA_NO_TRIANGLE);
        ray = good;
        ray.direction[axis] = kNan;
        EXPECT_EQ(mesh.by_tree(ray).triangle, MACULA_NO_TRIANGLE);
        EXPECT_EQ(mesh.by_brute_force(ray).triangle, MACULA_NO_TRIANGLE);
    }
}

TEST(BvhEdgeRays, InactiveIntervalsMiss) {
    const Soup soup = floor_of_quads(8);
    const OneMesh mesh(soup.geometry());
    const std::array<std::array<float, 2>, 5> intervals = {
        {{5, 1}, {-1, 5}, {kNan, 5}, {0, kNan}, {kInfinity, 5}}};
    for (const auto& [t_min, t_max] : intervals) {
        Ray ray = ray_between({0.25f, 2, 0.25f}, {0.25f, 0, 0.25f});
        ray.t_min = t_min;
        ray.t_max = t_max;
        EXPECT_EQ(mesh.by_tree(ray).triangle, MACULA_NO_TRIANGLE);
        EXPECT_EQ(mesh.by_brute_force(ray).triangle, MACULA_NO_TRIANGLE);
        EXPECT_FALSE(occluded(ray, mesh.scene()));
    }
}

TEST(BvhEdgeRays, InfiniteRaysAgree) {
    const Soup soup = floor_of_quads(8);
    const OneMesh mesh(soup.geometry());
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Ray ray = ray_between({0.25f, 2, 0.25f}, {0.25f, 0, 0.25f});
        ray.direction[axis] = -kInfinity;
        EXPECT_EQ(mesh.by_tree(ray).triangle, mesh.by_brute_force(ray).triangle);
        ray = ray_between({0.25f, 2, 0.25f}, {0.25f, 0, 0.25f}, kInfinity);
        expect_agreement(mesh, ray);
    }
}

TEST(BvhEdgeRays, ZeroLengthDirectionEndsAndAgrees) {
    const Soup soup = random_soup(500, 0.3f, 5);
    const OneMesh mesh(soup.geometry());
    Random random(6);
    for (int i = 0; i < 500; ++i) {
        const std::array<float, 3> p = {random(-1, 1), random(-1, 1), random(-1, 1)};
        expect_agreement(mesh, ray_between(p, p));
    }
}

TEST(BvhEdgeRays, InsideOutBoxIsNeverEntered) {
    Random random(7);
    for (int i = 0; i < 10000; ++i) {
        const Ray ray = random_ray(random, i % 2 == 0 ? 2.0f : 1e6f);
        const shared::TraceRay r = shared::make_trace_ray(
            ray.origin[0], ray.origin[1], ray.origin[2], i % 3 == 0 ? 0.0f : ray.direction[0],
            ray.direction[1], ray.direction[2], 0.0f, 1e30f);
        float near, far;
        shared::box_interval(&r, MACULA_EMPTY, MACULA_EMPTY, MACULA_EMPTY, -MACULA_EMPTY,
                             -MACULA_EMPTY, -MACULA_EMPTY, &near, &far);
        EXPECT_GT(near, far);
    }
}

TEST(BvhEdgeRays, CoincidentTrianglesGiveTheLowestId) {
    Soup soup;
    soup.add({-1, 0, -1, 1, 0, -1, 0, 0, 1});
    soup.triangles.resize(5000, soup.triangles[0]);
    const OneMesh mesh(soup.geometry());
    Random random(8);
    for (int i = 0; i < 300; ++i) {
        const shared::TraceHit hit = expect_agreement(
            mesh, ray_between({random(-1, 1), 1, random(-1, 1)}, {0, 0, random(-0.9f, 0.9f)}));
        EXPECT_EQ(hit.triangle, 0u);
    }
}

TEST(BvhEdgeRays, PointsAreNeverHit) {
    Soup soup;
    soup.add({0.3f, 0.1f, 0.2f, 0.3f, 0.1f, 0.2f, 0.3f, 0.1f, 0.2f});
    const OneMesh mesh(soup.geometry());
    Random random(9);
    for (int i = 0; i < 2000; ++i) {
        const Ray ray =
            ray_between({random(-2, 2), random(-2, 2), random(-2, 2)}, {0.3f, 0.1f, 0.2f});
        EXPECT_EQ(expect_agreement(mesh, ray).triangle, MACULA_NO_TRIANGLE);
    }
}

// Shearing rounds collinear vertices, so that a ray through the line may hit: but then always.
TEST(BvhEdgeRays, CollinearTrianglesAgree) {
    Soup soup;
    soup.add({-1, 0, 0, 0, 0, 0, 1, 0, 0});
    soup.add({-1, -1, 0, 1, 1, 0, -1, -1, 0});
    soup.add({-1, -0.3f, 0.7f, 1, 0.3f, -0.7f, 0.5f, 0.15f, -0.35f});
    const OneMesh mesh(soup.geometry());
    Random random(12);
    for (int i = 0; i < 6000; ++i) {
        const float s = random(-1, 1);
        const std::array<float, 3> target = {s, i % 3 == 0 ? 0.0f : (i % 3 == 1 ? s : 0.3f * s),
                                             i % 3 == 2 ? -0.7f * s : 0.0f};
        expect_agreement(mesh, ray_between({random(-2, 2), random(-2, 2), random(-2, 2)}, target));
    }
}

TEST(BvhEdgeRays, HugeCoordinatesAgree) {
    Soup soup = random_soup(300, 0.5f, 10);
    for (float& x : soup.positions)
        x *= 6e17f;
    const OneMesh mesh(soup.geometry());
    Random random(11);
    for (int i = 0; i < 2000; ++i)
        expect_agreement(mesh, random_ray(random, 1.8e18f));
}

} // namespace
} // namespace macula::bvh::test
