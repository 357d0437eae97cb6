// The tree of boxes that Bullet builds over an obstacle, unpacked, with the depth of its nodes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

class btQuantizedBvh;

namespace macula::scene::physics {

struct BoxNode {
    glm::vec3 lo, hi;
    // Of an inner node the index of its second child (the first one follows it); of a leaf -1 - the
    // index of its triangle.
    std::int32_t second_or_triangle;

    bool leaf() const { return second_or_triangle < 0; }
    std::int32_t triangle() const { return -1 - second_or_triangle; }
};

class BoxTree {
  public:
    // Deeper trees are refused: walks keep their stacks in arrays of this size.
    static constexpr int kMaxHeight = 62;

    // The boxes contain those of the exact walk: both are unpacked from the same 16-bit values.
    // Throws std::runtime_error for a tree deeper than kMaxHeight.
    explicit BoxTree(btQuantizedBvh& bvh);

    std::span<const BoxNode> nodes() const { return nodes_; } // [0] is the root, at level 0
    int height() const { return height_; }                    // level of the deepest leaf

  private:
    std::vector<BoxNode> nodes_;
    int height_ = 0;
};

} // namespace macula::scene::physics
