#include <algorithm>

#include <tbb/parallel_reduce.h>

#include "bvh/bvh.hpp"
#include "bvh/collapse.hpp"

namespace macula::bvh {
namespace {

std::uint32_t depth_of(const Tree& tree) {
    std::vector<std::uint8_t> depth(tree.nodes.size(), 0);
    std::uint32_t deepest = 0;
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
        deepest = std::max<std::uint32_t>(deepest, depth[i]);
        if (!tree.nodes[i].is_leaf())
            depth[i + 1] = depth[tree.nodes[i].right] = static_cast<std::uint8_t>(depth[i] + 1);
    }
    return deepest;
}

} // namespace

Statistics statistics(const Tree& tree, const Geometry& geometry, const BuildOptions& options) {
    Statistics result;
    result.nodes = static_cast<std::uint32_t>(tree.nodes.size());
    result.build_seconds = tree.build_seconds;
    if (tree.nodes.empty())
        return result;
    const CollapseOptions collapse = {2, MACULA_LEAF_MAX, 1, options.traversal_cost,
                                      options.intersection_cost};
    result.sah = Collapse(tree, collapse).cost();
    const auto triangles = static_cast<double>(geometry.triangles.size());
    result.duplication = tree.references / triangles;
    result.depth = depth_of(tree);
    result.bytes_per_triangle =
        static_cast<double>(tree.nodes.size() * sizeof(TreeNode)) / triangles;
    return result;
}

} // namespace macula::bvh
