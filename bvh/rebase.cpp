#include <stdexcept>

#include "bvh/bvh.hpp"

namespace macula::bvh {
namespace {

void move_child(int& child, std::uint32_t first_node, std::uint32_t first_triangle) {
    if (child >= 0) {
        child += static_cast<int>(first_node);
        return;
    }
    const auto leaf = static_cast<std::uint32_t>(~child);
    if (leaf != 0) // an empty slot stays one
        child = static_cast<int>(~(leaf + (first_triangle << MACULA_LEAF_COUNT_BITS)));
}

template <typename Node>
void move_children(LaidOut& mesh, std::uint32_t first_node, std::uint32_t first_triangle) {
    auto* nodes = reinterpret_cast<Node*>(mesh.nodes.data());
    for (std::uint32_t i = 0; i < mesh.node_count; ++i) {
        for (int& child : nodes[i].child)
            move_child(child, first_node, first_triangle);
    }
}

void move_skips(LaidOut& mesh, std::uint32_t first_node, std::uint32_t first_triangle) {
    auto* nodes = reinterpret_cast<shared::SkipNode*>(mesh.nodes.data());
    for (std::uint32_t i = 0; i < mesh.node_count; ++i) {
        if (nodes[i].skip != MACULA_SKIP_END)
            nodes[i].skip += first_node;
        if (nodes[i].leaf != 0)
            nodes[i].leaf += first_triangle << MACULA_LEAF_COUNT_BITS;
    }
}

} // namespace

void rebase(LaidOut& mesh, std::uint32_t first_node, std::uint32_t first_triangle) {
    const std::uint64_t nodes = std::uint64_t{first_node} + mesh.node_count;
    const std::uint64_t triangles = std::uint64_t{first_triangle} + mesh.triangle_entries;
    if (nodes >= (std::uint64_t{1} << 31) || triangles >= (std::uint64_t{1} << 27))
        throw std::invalid_argument("BVH rebase: more than 2^31 - 1 nodes or 2^27 - 1 triangle "
                                    "entries in one buffer");
    switch (mesh.layout) {
    case Layout::binary:
        move_children<shared::BinaryNode>(mesh, first_node, first_triangle);
        break;
    case Layout::wide8_single:
    case Layout::wide8_block:
        move_children<shared::Wide8Node>(mesh, first_node, first_triangle);
        break;
    case Layout::quantized8:
        move_children<shared::Quantized8Node>(mesh, first_node, first_triangle);
        break;
    case Layout::skip:
        move_skips(mesh, first_node, first_triangle);
        break;
    }
    mesh.root += static_cast<int>(first_node);
}

} // namespace macula::bvh
