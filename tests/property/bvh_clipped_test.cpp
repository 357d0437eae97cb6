// Spatial splits give triangles boxes that hold only a part of them. No hit may be lost for that:
// the tree must find what brute force finds, bit for bit, also for rays aimed exactly at split
// planes, at vertices and along edges (docs/arithmetic.md, "Parts of triangles"). Here with whole
// trees; bvh_parts_test.cpp puts many more rays to single triangles.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/bvh_scenes.hpp"

namespace macula::bvh::test {
namespace {

using Point = std::array<float, 3>;

BuildOptions eager() {
    BuildOptions options;
    options.overlap_threshold = 0.0f;
    options.duplication_budget = 4.0f;
    return options;
}

Point corner(const Soup& soup, std::uint32_t triangle, std::uint32_t i) {
    const float* p = soup.positions.data() + std::size_t{3} * soup.triangles[triangle][i];
    return {p[0], p[1], p[2]};
}

Point mix(const Point& a, const Point& b, float s) {
    Point p;
    for (std::size_t i = 0; i < 3; ++i)
        p[i] = a[i] + (b[i] - a[i]) * s;
    return p;
}

// Targets near which a clipped box can end: planes of leaf boxes where they cross a triangle, the
// triangle's corners, points of its edges, points inside.
class Targets {
  public:
    Targets(const Soup& soup, const Tree& tree, std::uint32_t seed) : soup_(soup), random_(seed) {
        for (const TreeNode& node : tree.nodes) {
            if (node.is_leaf())
                leaves_.push_back(node);
        }
    }

    Point next() {
        const TreeNode& leaf = leaves_[random_.below(static_cast<std::uint32_t>(leaves_.size()))];
        const std::uint32_t t = leaf.triangle;
        const Point a = corner(soup_, t, 0), b = corner(soup_, t, 1), c = corner(soup_, t, 2);
        switch (random_.below(4)) {
        case 0:
            return corner(soup_, t, random_.below(3));
        case 1:
            return mix(a, random_.below(2) == 0 ? b : c, random_(0, 1));
        case 2:
            return mix(mix(a, b, random_(0, 1)), c, random_(0, 1));
        default:
            return on_plane(leaf, mix(a, c, random_(0, 1)), mix(b, c, random_(0, 1)));
        }
    }

  private:
    // Where the segment a-b, within the triangle, crosses one of the leaf's planes.
    Point on_plane(const TreeNode& leaf, const Point& a, const Point& b) {
        const std::size_t axis = random_.below(3);
        const float plane = random_.below(2) == 0 ? leaf.box.lo[axis] : leaf.box.hi[axis];
        if ((a[axis] < plane) == (b[axis] < plane))
            return mix(a, b, random_(0, 1));
        Point p = mix(a, b, (plane - a[axis]) / (b[axis] - a[axis]));
        p[axis] = plane;
        return p;
    }

    const Soup& soup_;
    Random random_;
    std::vector<TreeNode> leaves_;
};

struct Origins {
    float reach;          // largest coordinate
    bool on_axes = false; // directions with two zero components
};

Point origin_for(const Origins& origins, const Point& target, Random& random) {
    Point o = {random(-origins.reach, origins.reach), random(-origins.reach, origins.reach),
               random(-origins.reach, origins.reach)};
    if (origins.on_axes) {
        const std::size_t keep = random.below(3);
        for (std::size_t axis = 0; axis < 3; ++axis)
            o[axis] = axis == keep ? o[axis] : target[axis];
    }
    return o;
}

void expect_no_lost_hit(const Soup& soup, const Origins& origins, int rays, std::uint32_t seed) {
    const OneMesh mesh(soup.geometry(), eager());
    const double duplication =
        static_cast<double>(mesh.tree.references) / static_cast<double>(soup.triangles.size());
    EXPECT_GT(duplication, 1.02) << "the scene does not exercise clipped references";
    Targets targets(soup, mesh.tree, seed);
    Random random(seed + 1);
    int hits = 0, mismatches = 0;
    for (int i = 0; i < rays; ++i) {
        const Point target = targets.next();
        const Ray ray = ray_between(origin_for(origins, target, random), target);
        const shared::TraceHit brute = mesh.by_brute_force(ray);
        hits += brute.triangle != MACULA_NO_TRIANGLE ? 1 : 0;
        mismatches += same_bits(mesh.by_tree(ray), brute) ? 0 : 1;
    }
    EXPECT_EQ(mismatches, 0);
    EXPECT_GT(hits, rays / 4);
}

TEST(BvhClipped, ThinDiagonalTriangles) {
    expect_no_lost_hit(needles(150, 1), {2.0f}, 50000, 2);
}

TEST(BvhClipped, OriginsFarAway) {
    expect_no_lost_hit(needles(150, 7), {1e4f}, 50000, 8);
}

TEST(BvhClipped, DirectionsWithZeroComponents) {
    expect_no_lost_hit(needles(150, 11), {2.0f, true}, 50000, 12);
}

TEST(BvhClipped, MeshFarFromTheOrigin) {
    Soup soup = needles(150, 13);
    for (float& x : soup.positions)
        x += 1000.0f;
    expect_no_lost_hit(soup, {1002.0f}, 50000, 14);
}

} // namespace
} // namespace macula::bvh::test
