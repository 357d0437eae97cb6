#include "bvh/octant_slots.hpp"

#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace {
using namespace macula::bvh;

constexpr Box kUnit = {{0, 0, 0}, {1, 1, 1}};

// A small box around the middle of octant `o` of the unit cube.
Child in_octant(unsigned o) {
    Child child;
    for (unsigned axis = 0; axis < 3; ++axis) {
        const float middle = (o >> axis & 1u) != 0 ? 0.75f : 0.25f;
        child.box.lo[axis] = middle - 0.1f;
        child.box.hi[axis] = middle + 0.1f;
    }
    return child;
}

TEST(OctantSlots, EachChildInItsCorner) {
    std::vector<Child> children;
    for (const unsigned octant : {5u, 0u, 7u, 2u, 1u, 6u, 3u, 4u})
        children.push_back(in_octant(octant));
    const auto slots = octant_slots(kUnit, children);
    EXPECT_EQ(slots, (std::array<std::uint8_t, 8>{5, 0, 7, 2, 1, 6, 3, 4}));
}

TEST(OctantSlots, FewChildrenTakeTheirCorners) {
    const std::vector<Child> children = {in_octant(6), in_octant(1)};
    const auto slots = octant_slots(kUnit, children);
    EXPECT_EQ(slots[0], 6);
    EXPECT_EQ(slots[1], 1);
}

TEST(OctantSlots, EqualChildrenTakeDifferentSlots) {
    const std::vector<Child> children(8, in_octant(3));
    const auto slots = octant_slots(kUnit, children);
    EXPECT_EQ(std::set<int>(slots.begin(), slots.end()).size(), 8u);
}

TEST(OctantSlots, FlatNodes) {
    const Box flat = {{0, 0, 0}, {1, 0, 0}};
    const std::vector<Child> children = {{flat, 0}, {flat, 1}, {flat, 2}};
    const auto slots = octant_slots(flat, children);
    EXPECT_EQ(std::set<int>(slots.begin(), slots.begin() + 3).size(), 3u);
}

} // namespace
