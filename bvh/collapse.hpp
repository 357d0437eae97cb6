// Collapses the binary tree into nodes of up to eight children and leaves of several triangles, at
// the least surface area cost (Ylitie, Karras and Laine 2017, section 3.1: dynamic programming).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bvh/bvh.hpp"

namespace macula::bvh {

struct CollapseOptions {
    std::uint32_t width = 2;     // children of a node, 2..8
    std::uint32_t leaf_size = 4; // most references in a leaf, 1..15
    std::uint32_t leaf_unit = 1; // triangles that are tested at once
    float node_cost = 1.0f;      // of visiting a node
    float leaf_cost = 1.0f;      // of testing one unit of a leaf
};

class Collapse {
  public:
    Collapse(const Tree& tree, const CollapseOptions& options);

    // Indices of tree nodes, at most `width`.
    struct Children {
        std::array<std::uint32_t, 8> node{};
        std::uint32_t count = 0;
    };
    // Whether tree node `node`, a child of a collapsed node or the root, has become a leaf.
    bool is_leaf(std::uint32_t node) const { return choice_[node][0] != 0; }
    // Of an inner node, largest box first.
    Children children(std::uint32_t node) const;
    // Different triangles in a leaf, in ascending order of their ids.
    struct Triangles {
        std::array<std::uint32_t, MACULA_LEAF_MAX> id{};
        std::uint32_t count = 0;
    };
    Triangles triangles(std::uint32_t leaf) const;
    // Estimated cost of the collapsed tree, relative to the root's area.
    double cost() const { return cost_; }

  private:
    // [i]: least cost of a subtree as at most i + 1 roots of collapsed subtrees.
    using Costs = std::array<float, 7>;
    // [0]: is a leaf; [j - 1]: roots out of j that the left child gets, 0: as for j - 1.
    using Choice = std::array<std::uint8_t, 8>;

    Costs decide(std::uint32_t node, std::uint32_t end);
    float relative_area(std::uint32_t node) const;
    float leaf_cost(std::uint32_t node, std::uint32_t end) const;
    void gather(std::uint32_t node, std::uint32_t roots, Children& children) const;

    const Tree& tree_;
    CollapseOptions options_;
    std::vector<Choice> choice_;
    float scale_ = 0.0f;
    double cost_ = 0.0;
};

inline float half_area(const Box& box) {
    const float x = box.hi[0] - box.lo[0], y = box.hi[1] - box.lo[1], z = box.hi[2] - box.lo[2];
    return x * (y + z) + y * z;
}

} // namespace macula::bvh
