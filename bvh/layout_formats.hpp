// How each layout writes its nodes and its leaves.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "bvh/bvh.hpp"

namespace macula::bvh {

// A child of a node that is being written: its box and its child reference.
struct Child {
    Box box;
    int reference = -1;
};

inline constexpr Box kEmptyBox = {{MACULA_EMPTY, MACULA_EMPTY, MACULA_EMPTY},
                                  {-MACULA_EMPTY, -MACULA_EMPTY, -MACULA_EMPTY}};

// Unused slots of the node become empty. `box` is the node's own and contains the children's.
void write_node(shared::BinaryNode& node, const Box& box, std::span<const Child> children);
void write_node(shared::Wide8Node& node, const Box& box, std::span<const Child> children);
void write_node(shared::Quantized8Node& node, const Box& box, std::span<const Child> children);

// Entries of a leaf: `ids.size()` Triangles, or the TriangleBlock8s that hold them.
std::uint32_t entries_for(const shared::Triangle*, std::uint32_t triangles);
std::uint32_t entries_for(const shared::TriangleBlock8*, std::uint32_t triangles);
void write_leaf(shared::Triangle* entries, const Geometry& geometry,
                std::span<const std::uint32_t> ids);
void write_leaf(shared::TriangleBlock8* entries, const Geometry& geometry,
                std::span<const std::uint32_t> ids);

} // namespace macula::bvh
