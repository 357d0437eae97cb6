// What the builder returns, and what it refuses.
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/bvh_scenes.hpp"

namespace macula::bvh::test {
namespace {

std::string refusal(const Geometry& geometry, const BuildOptions& options = {}) {
    try {
        build(geometry, options);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

// Every triangle is in some leaf, parents contain children, the depth is within its bound.
void expect_sound(const Tree& tree, const Geometry& geometry) {
    std::set<std::uint32_t> seen;
    std::uint32_t leaves = 0;
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
        const TreeNode& node = tree.nodes[i];
        if (node.is_leaf()) {
            ++leaves;
            seen.insert(node.triangle);
            continue;
        }
        ASSERT_GT(node.right, i + 1);
        ASSERT_LT(node.right, tree.nodes.size());
        for (const std::uint32_t child : {i + 1, node.right}) {
            for (int axis = 0; axis < 3; ++axis) {
                ASSERT_LE(node.box.lo[axis], tree.nodes[child].box.lo[axis]);
                ASSERT_GE(node.box.hi[axis], tree.nodes[child].box.hi[axis]);
            }
        }
    }
    EXPECT_EQ(leaves, tree.references);
    EXPECT_EQ(seen.size(), geometry.triangles.size());
    EXPECT_LT(statistics(tree, geometry).depth, MACULA_MAX_DEPTH);
}

bool same_tree(const Tree& a, const Tree& b) {
    return a.nodes.size() == b.nodes.size() &&
           std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(TreeNode)) == 0;
}

TEST(BvhBuild, EmptyGeometryGivesAnEmptyTree) {
    const Tree tree = build({});
    EXPECT_TRUE(tree.nodes.empty());
    EXPECT_EQ(tree.references, 0u);
    EXPECT_EQ(statistics(tree, {}).sah, 0.0);
}

TEST(BvhBuild, SingleTriangle) {
    const Soup soup = random_soup(1, 0.5f, 1);
    const Tree tree = build(soup.geometry());
    ASSERT_EQ(tree.nodes.size(), 1u);
    EXPECT_TRUE(tree.nodes[0].is_leaf());
}

TEST(BvhBuild, EverySmallCount) {
    for (std::uint32_t count = 2; count < 40; ++count) {
        const Soup soup = random_soup(count, 0.5f, count);
        expect_sound(build(soup.geometry()), soup.geometry());
    }
}

TEST(BvhBuild, RandomSoupAndNeedles) {
    for (const Soup& soup : {random_soup(20000, 0.05f, 1), needles(5000, 2)})
        expect_sound(build(soup.geometry()), soup.geometry());
}

TEST(BvhBuild, TheSameTreeWithAnyNumberOfThreads) {
    for (const Soup& soup : {random_soup(50000, 0.05f, 3), needles(20000, 4)}) {
        BuildOptions one;
        one.threads = 1;
        const Tree reference = build(soup.geometry(), one);
        for (const std::uint32_t threads : {2u, 2u, 3u, 0u}) {
            BuildOptions options;
            options.threads = threads;
            EXPECT_TRUE(same_tree(reference, build(soup.geometry(), options))) << threads;
        }
    }
}

TEST(BvhBuild, AMillionCoincidentTriangles) {
    Soup soup;
    soup.add({0, 0, 0, 1, 0, 0, 0, 1, 0.5f});
    soup.triangles.resize(1000000, soup.triangles[0]);
    const Tree tree = build(soup.geometry());
    EXPECT_EQ(tree.references, 1000000u);
    EXPECT_LE(statistics(tree, soup.geometry()).depth, 21u);
}

// Each split separates few of these from many: a builder that only follows the cost goes deep.
TEST(BvhBuild, GeometricProgressionStaysWithinTheDepthBound) {
    Soup soup;
    for (int i = 0; i < 120; ++i) {
        const float x = std::ldexp(1.0f, i / 2 - 30);
        for (int k = 0; k < 200; ++k)
            soup.add({x, 0, 0, 2 * x, 0, x, x, x, 0});
    }
    expect_sound(build(soup.geometry()), soup.geometry());
}

TEST(BvhBuild, DegenerateTrianglesAreKept) {
    Soup soup = random_soup(100, 0.2f, 5);
    for (int i = 0; i < 100; ++i) {
        const auto x = static_cast<float>(i) * 0.01f;
        soup.add({x, 0, 0, x, 0, 0, x, 0, 0});      // a point
        soup.add({x, 0, 0, 0, x, 0, 2 * x, -x, 0}); // collinear
    }
    expect_sound(build(soup.geometry()), soup.geometry());
}

TEST(BvhBuild, HugeCoordinates) {
    Soup soup = needles(1000, 6);
    for (float& x : soup.positions)
        x *= 9e17f;
    expect_sound(build(soup.geometry()), soup.geometry());
}

TEST(BvhBuild, DenormalCoordinates) {
    Soup soup = needles(1000, 7);
    for (float& x : soup.positions)
        x *= 1e-40f;
    expect_sound(build(soup.geometry()), soup.geometry());
}

TEST(BvhBuild, DuplicatesStayWithinTheBudget) {
    const Soup soup = needles(3000, 8);
    for (const float budget : {0.0f, 0.1f, 0.5f, 2.0f}) {
        BuildOptions options;
        options.duplication_budget = budget;
        const Statistics result = statistics(build(soup.geometry(), options), soup.geometry());
        EXPECT_LE(result.duplication, 1.0 + budget);
    }
    BuildOptions none;
    none.spatial_splits = false;
    EXPECT_EQ(build(soup.geometry(), none).references, 3000u);
}

TEST(BvhBuild, SpatialSplitsLowerTheCostOfNeedles) {
    const Soup soup = needles(3000, 9);
    BuildOptions without;
    without.spatial_splits = false;
    EXPECT_LT(statistics(build(soup.geometry()), soup.geometry()).sah,
              0.95 * statistics(build(soup.geometry(), without), soup.geometry()).sah);
}

TEST(BvhBuild, NonFiniteCoordinatesAreRefusedWithTheirIndex) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(),
                            std::numeric_limits<float>::infinity(), -2e18f}) {
        Soup soup = random_soup(20000, 0.1f, 10);
        soup.positions[3 * 12345 + 1] = bad;
        soup.positions[3 * 23456 + 2] = bad;
        EXPECT_THAT(refusal(soup.geometry()), testing::HasSubstr("coordinate y of vertex 12345"));
    }
}

TEST(BvhBuild, IndexOutOfRangeIsRefusedWithItsTriangle) {
    Soup soup = random_soup(20000, 0.1f, 11);
    soup.triangles[15000][2] = 60000;
    soup.triangles[17000][0] = 0xffffffffu;
    EXPECT_THAT(refusal(soup.geometry()),
                testing::HasSubstr("triangle 15000 uses vertex 60000, but there are only 60000"));
}

TEST(BvhBuild, ArraysThatDoNotFitAreRefused) {
    Soup soup = random_soup(10, 0.1f, 12);
    Geometry geometry = soup.geometry();
    const std::vector<std::uint8_t> masked(9);
    geometry.masked = masked;
    EXPECT_THAT(refusal(geometry), testing::HasSubstr("masked has 9 entries for 10 triangles"));
    soup.positions.pop_back();
    EXPECT_THAT(refusal(soup.geometry()), testing::HasSubstr("not a multiple of 3"));
}

TEST(BvhBuild, OptionsOutOfRangeAreRefused) {
    BuildOptions options;
    options.bins = 1;
    EXPECT_THAT(refusal({}, options), testing::HasSubstr("bins is 1"));
    options.bins = 129;
    EXPECT_THAT(refusal({}, options), testing::HasSubstr("bins is 129"));
    options = {};
    options.duplication_budget = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT(refusal({}, options), testing::HasSubstr("duplication_budget"));
}

} // namespace
} // namespace macula::bvh::test
