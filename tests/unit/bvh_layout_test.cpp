// The layouts hold the tree: boxes contain what they bound, as the kernels evaluate them, and no
// triangle is lost.
#include <bit>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "tests/support/bvh_scenes.hpp"

namespace macula::bvh::test {
namespace {

using shared::BinaryNode, shared::Quantized8Node, shared::SkipNode, shared::Triangle,
    shared::TriangleBlock8, shared::Wide8Node;

template <typename T>
const T* as(const std::vector<std::byte>& bytes) {
    return reinterpret_cast<const T*>(bytes.data());
}

Box child_box(const BinaryNode& node, int i) {
    const auto& b = node.box[i];
    return {{b[0][0], b[1][0], b[2][0]}, {b[0][1], b[1][1], b[2][1]}};
}

Box child_box(const Wide8Node& node, int i) {
    const auto& p = node.plane;
    return {{p[0][0][i], p[1][0][i], p[2][0][i]}, {p[0][1][i], p[1][1][i], p[2][1][i]}};
}

Box child_box(const Quantized8Node& node, int i) {
    Box box{};
    for (int axis = 0; axis < 3; ++axis) {
        const float scale = std::bit_cast<float>(((node.exponent >> (8 * axis)) & 0xffu) << 23);
        box.lo[axis] = std::fma(static_cast<float>(node.lo[axis][i]), scale, node.origin[axis]);
        box.hi[axis] = std::fma(static_cast<float>(node.hi[axis][i]), scale, node.origin[axis]);
    }
    return box;
}

bool contains(const Box& outer, const Box& inner) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!(outer.lo[axis] <= inner.lo[axis] && outer.hi[axis] >= inner.hi[axis]))
            return false;
    }
    return true;
}

bool is_inverted(const Box& box) {
    return box.lo[0] > box.hi[0] && box.lo[1] > box.hi[1] && box.lo[2] > box.hi[2];
}

std::set<std::uint32_t> ids_of(const Triangle* entries, std::uint32_t first, std::uint32_t count) {
    std::set<std::uint32_t> ids;
    for (std::uint32_t i = first; i < first + count; ++i)
        EXPECT_TRUE(ids.insert(entries[i].id).second) << "a triangle twice in a leaf";
    return ids;
}

std::set<std::uint32_t> ids_of(const TriangleBlock8* entries, std::uint32_t first,
                               std::uint32_t count) {
    std::set<std::uint32_t> ids;
    for (std::uint32_t i = first; i < first + count; ++i) {
        for (const std::uint32_t id : entries[i].id) {
            if (id != MACULA_NO_TRIANGLE) {
                EXPECT_TRUE(ids.insert(id).second) << "a triangle twice in a leaf";
            }
        }
    }
    return ids;
}

// Walks a layout from its root; hands every leaf's box and ids to `visit`. Checks that the leaf's
// box lies in its parents' ones.
template <typename Node, typename Entry>
void walk(const LaidOut& mesh, int reference, const Box& box, std::vector<bool>& seen,
          const std::function<void(const Box&, const std::set<std::uint32_t>&)>& visit) {
    if (reference < 0) {
        const auto bits = static_cast<std::uint32_t>(~reference);
        const std::uint32_t first = bits >> MACULA_LEAF_COUNT_BITS;
        const std::uint32_t count = bits & MACULA_LEAF_MAX;
        ASSERT_LE(first + count, mesh.triangle_entries);
        visit(box, ids_of(as<Entry>(mesh.triangles), first, count));
        return;
    }
    ASSERT_LT(static_cast<std::uint32_t>(reference), mesh.node_count);
    ASSERT_FALSE(seen[static_cast<std::size_t>(reference)]);
    seen[static_cast<std::size_t>(reference)] = true;
    const Node& node = as<Node>(mesh.nodes)[reference];
    for (int i = 0; i < static_cast<int>(std::size(node.child)); ++i) {
        const Box child = child_box(node, i);
        if (node.child[i] == -1) {
            EXPECT_TRUE(is_inverted(child));
            continue;
        }
        if constexpr (!std::is_same_v<Node, Quantized8Node>) {
            ASSERT_TRUE(contains(box, child));
        }
        walk<Node, Entry>(mesh, node.child[i], child, seen, visit);
    }
}

// Every reference of the tree lies in a leaf of the layout whose box contains the reference's.
template <typename Node, typename Entry>
void expect_holds(const Tree& tree, const LaidOut& mesh, std::size_t largest_leaf) {
    std::multimap<std::uint32_t, Box> found;
    std::vector<bool> seen(mesh.node_count);
    walk<Node, Entry>(mesh, mesh.root, mesh.box, seen,
                      [&](const Box& box, const std::set<std::uint32_t>& ids) {
                          EXPECT_LE(ids.size(), largest_leaf);
                          for (const std::uint32_t id : ids)
                              found.emplace(id & MACULA_ID_MASK, box);
                      });
    EXPECT_EQ(std::count(seen.begin(), seen.end(), false), 0) << "nodes that nothing refers to";
    for (const TreeNode& node : tree.nodes) {
        if (!node.is_leaf())
            continue;
        const auto [begin, end] = found.equal_range(node.triangle);
        EXPECT_TRUE(std::any_of(
            begin, end, [&](const auto& entry) { return contains(entry.second, node.box); }))
            << "triangle " << node.triangle;
    }
}

std::vector<Soup> soups() {
    std::vector<Soup> result = {random_soup(1, 0.5f, 1), random_soup(2, 0.5f, 2),
                                random_soup(9, 0.5f, 3), random_soup(5000, 0.05f, 4),
                                needles(3000, 5),        random_soup(60000, 0.02f, 6)};
    Soup far = needles(2000, 7);
    for (float& x : far.positions)
        x = x * 0.01f + 12345.0f;
    result.push_back(far);
    Soup coincident = random_soup(1, 0.5f, 8);
    coincident.triangles.resize(1000, coincident.triangles[0]);
    result.push_back(coincident);
    return result;
}

TEST(BvhLayout, BinaryHoldsTheTree) {
    for (const Soup& soup : soups()) {
        const Tree tree = build(soup.geometry());
        expect_holds<BinaryNode, Triangle>(tree, lay_out(tree, soup.geometry(), Layout::binary), 4);
    }
}

TEST(BvhLayout, Wide8WithSingleTrianglesHoldsTheTree) {
    for (const Soup& soup : soups()) {
        const Tree tree = build(soup.geometry());
        expect_holds<Wide8Node, Triangle>(tree,
                                          lay_out(tree, soup.geometry(), Layout::wide8_single), 2);
    }
}

TEST(BvhLayout, Wide8WithBlocksHoldsTheTree) {
    for (const Soup& soup : soups()) {
        const Tree tree = build(soup.geometry());
        expect_holds<Wide8Node, TriangleBlock8>(
            tree, lay_out(tree, soup.geometry(), Layout::wide8_block), 8);
    }
}

TEST(BvhLayout, QuantisedBoxesContainTheExactOnes) {
    for (const Soup& soup : soups()) {
        const Tree tree = build(soup.geometry());
        expect_holds<Quantized8Node, Triangle>(
            tree, lay_out(tree, soup.geometry(), Layout::quantized8), 4);
    }
}

// What a walk that enters everything, or skips at random, must visit.
TEST(BvhLayout, SkipPointersLeadOverWholeSubtrees) {
    for (const Soup& soup : soups()) {
        const Tree tree = build(soup.geometry());
        const LaidOut mesh = lay_out(tree, soup.geometry(), Layout::skip);
        const auto* nodes = as<SkipNode>(mesh.nodes);
        std::set<std::uint32_t> ids;
        for (std::uint32_t i = 0; i < mesh.node_count; ++i) {
            const SkipNode& node = nodes[i];
            const std::uint32_t next = node.skip == MACULA_SKIP_END ? mesh.node_count : node.skip;
            ASSERT_GT(next, i);
            const Box box = {{node.lo[0], node.lo[1], node.lo[2]},
                             {node.hi[0], node.hi[1], node.hi[2]}};
            for (std::uint32_t k = i + 1; k < std::min(next, i + 64); ++k)
                EXPECT_TRUE(contains(box, {{nodes[k].lo[0], nodes[k].lo[1], nodes[k].lo[2]},
                                           {nodes[k].hi[0], nodes[k].hi[1], nodes[k].hi[2]}}));
            if (node.leaf != 0) {
                EXPECT_EQ(next, i + 1);
                ids.merge(ids_of(as<Triangle>(mesh.triangles), node.leaf >> MACULA_LEAF_COUNT_BITS,
                                 node.leaf & MACULA_LEAF_MAX));
            }
        }
        EXPECT_EQ(ids.size(), soup.triangles.size());
    }
}

TEST(BvhLayout, EmptyMeshHasARootThatNoRayEnters) {
    for (const Layout layout : kLayouts) {
        const LaidOut mesh = lay_out({}, {}, layout);
        EXPECT_EQ(mesh.root, 0);
        EXPECT_EQ(mesh.node_count, 1u);
        EXPECT_EQ(mesh.triangle_entries, 0u);
        EXPECT_TRUE(is_inverted(mesh.box));
    }
}

TEST(BvhLayout, MaskedTrianglesCarryTheBit) {
    Soup soup = random_soup(100, 0.2f, 9);
    soup.masked.assign(100, 0);
    soup.masked[17] = soup.masked[42] = 1;
    const LaidOut mesh = lay_out(build(soup.geometry()), soup.geometry(), Layout::wide8_block);
    std::set<std::uint32_t> masked;
    const auto* blocks = as<TriangleBlock8>(mesh.triangles);
    for (const std::uint32_t id : ids_of(blocks, 0, mesh.triangle_entries)) {
        if ((id & MACULA_MASKED_BIT) != 0)
            masked.insert(id & MACULA_ID_MASK);
    }
    EXPECT_EQ(masked, (std::set<std::uint32_t>{17, 42}));
}

TEST(BvhLayout, RebaseMovesEveryReferenceButEmptySlots) {
    const Soup soup = random_soup(1000, 0.1f, 10);
    const Tree tree = build(soup.geometry());
    LaidOut mesh = lay_out(tree, soup.geometry(), Layout::wide8_single);
    const LaidOut original = mesh;
    rebase(mesh, 100, 2000);
    EXPECT_EQ(mesh.root, original.root + 100);
    for (std::uint32_t i = 0; i < mesh.node_count; ++i) {
        for (int k = 0; k < 8; ++k) {
            const int before = as<Wide8Node>(original.nodes)[i].child[k];
            const int after = as<Wide8Node>(mesh.nodes)[i].child[k];
            const int leaf = static_cast<int>(
                ~(static_cast<std::uint32_t>(~before) + (2000u << MACULA_LEAF_COUNT_BITS)));
            EXPECT_EQ(after, before >= 0 ? before + 100 : (before == -1 ? -1 : leaf));
        }
    }
    EXPECT_THROW(rebase(mesh, 0, 1u << 27), std::invalid_argument);
}

TEST(BvhLayout, LargestChildComesFirst) {
    const Soup soup = random_soup(5000, 0.1f, 11);
    const LaidOut mesh = lay_out(build(soup.geometry()), soup.geometry(), Layout::wide8_block);
    const auto area = [](const Box& b) {
        const float x = b.hi[0] - b.lo[0], y = b.hi[1] - b.lo[1], z = b.hi[2] - b.lo[2];
        return x * (y + z) + y * z;
    };
    for (std::uint32_t i = 0; i < mesh.node_count; ++i) {
        const Wide8Node& node = as<Wide8Node>(mesh.nodes)[i];
        for (int k = 1; k < 8 && node.child[k] != -1; ++k)
            EXPECT_LE(area(child_box(node, k)), area(child_box(node, k - 1)));
    }
}

} // namespace
} // namespace macula::bvh::test
