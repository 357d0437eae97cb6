#include "bvh/layout_skip.hpp"

#include <algorithm>
#include <cstring>

#include "bvh/layout_formats.hpp"

namespace macula::bvh {
namespace {

class SkipWriter {
  public:
    SkipWriter(const Tree& tree, const Geometry& geometry, const CollapseOptions& options)
        : tree_(tree), geometry_(geometry), collapse_(tree, options) {}

    LaidOut run() {
        LaidOut result;
        result.layout = Layout::skip;
        result.box = tree_.nodes.empty() ? kEmptyBox : tree_.nodes[0].box;
        if (tree_.nodes.empty())
            nodes_.push_back(make_node(kEmptyBox));
        else
            write(0);
        // What follows the last node of the whole tree is the end.
        for (shared::SkipNode& node : nodes_)
            node.skip = node.skip >= nodes_.size() ? MACULA_SKIP_END : node.skip;
        result.node_count = static_cast<std::uint32_t>(nodes_.size());
        result.triangle_entries = static_cast<std::uint32_t>(triangles_.size());
        result.nodes.resize(nodes_.size() * sizeof nodes_[0]);
        result.triangles.resize(triangles_.size() * sizeof triangles_[0]);
        std::memcpy(result.nodes.data(), nodes_.data(), result.nodes.size());
        if (!triangles_.empty())
            std::memcpy(result.triangles.data(), triangles_.data(), result.triangles.size());
        return result;
    }

  private:
    static shared::SkipNode make_node(const Box& box) {
        shared::SkipNode node{};
        std::copy_n(box.lo, 3, node.lo);
        std::copy_n(box.hi, 3, node.hi);
        node.skip = MACULA_SKIP_END;
        return node;
    }

    void write(std::uint32_t tree_node) {
        const std::size_t index = nodes_.size();
        nodes_.push_back(make_node(tree_.nodes[tree_node].box));
        if (collapse_.is_leaf(tree_node)) {
            nodes_[index].leaf = write_leaf_of(tree_node);
        } else {
            write(tree_node + 1);
            write(tree_.nodes[tree_node].right);
        }
        nodes_[index].skip = static_cast<std::uint32_t>(nodes_.size());
    }

    std::uint32_t write_leaf_of(std::uint32_t tree_node) {
        const auto triangles = collapse_.triangles(tree_node);
        const auto first = static_cast<std::uint32_t>(triangles_.size());
        triangles_.resize(triangles_.size() + triangles.count);
        write_leaf(triangles_.data() + first, geometry_, {triangles.id.data(), triangles.count});
        return first << MACULA_LEAF_COUNT_BITS | triangles.count;
    }

    const Tree& tree_;
    const Geometry& geometry_;
    Collapse collapse_;
    std::vector<shared::SkipNode> nodes_;
    std::vector<shared::Triangle> triangles_;
};

} // namespace

LaidOut lay_out_skip(const Tree& tree, const Geometry& geometry, const CollapseOptions& options) {
    return SkipWriter(tree, geometry, options).run();
}

} // namespace macula::bvh
