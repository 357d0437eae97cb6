#include "bvh/collapse.hpp"

#include <algorithm>
#include <limits>

#include <tbb/parallel_invoke.h>

namespace macula::bvh {
namespace {

constexpr std::uint32_t kParallelNodes = 8192;
constexpr float kNever = std::numeric_limits<float>::infinity();

} // namespace

Collapse::Collapse(const Tree& tree, const CollapseOptions& options)
    : tree_(tree), options_(options), choice_(tree.nodes.size()) {
    if (tree.nodes.empty())
        return;
    // Relative areas: neither huge nor tiny meshes leave the range of floats.
    const float root_area = half_area(tree.nodes[0].box);
    scale_ = root_area > 1e-30f ? 1.0f / root_area : 0.0f;
    cost_ = double{decide(0, static_cast<std::uint32_t>(tree.nodes.size()))[0]};
}

float Collapse::relative_area(std::uint32_t node) const {
    return half_area(tree_.nodes[node].box) * scale_;
}

float Collapse::leaf_cost(std::uint32_t node, std::uint32_t end) const {
    const std::uint32_t references = (end - node + 1) / 2;
    if (references > options_.leaf_size)
        return kNever;
    const std::uint32_t units =
        (triangles(node).count + options_.leaf_unit - 1) / options_.leaf_unit;
    return relative_area(node) * options_.leaf_cost * static_cast<float>(units);
}

// `end` is the index behind the subtree's last node.
Collapse::Costs Collapse::decide(std::uint32_t node, std::uint32_t end) {
    Costs costs;
    Choice& choice = choice_[node];
    if (tree_.nodes[node].is_leaf()) {
        costs.fill(leaf_cost(node, end));
        choice[0] = 1;
        return costs;
    }
    Costs left, right;
    const std::uint32_t middle = tree_.nodes[node].right;
    const auto decide_left = [&] { left = decide(node + 1, middle); };
    const auto decide_right = [&] { right = decide(middle, end); };
    if (end - node > kParallelNodes) {
        tbb::parallel_invoke(decide_left, decide_right);
    } else {
        decide_left();
        decide_right();
    }
    std::array<float, 9> divided; // least cost with j roots below this node
    for (std::uint32_t j = 2; j <= options_.width; ++j) {
        divided[j] = kNever;
        for (std::uint32_t k = 1; k < j; ++k) {
            const float cost = left[k - 1] + right[j - k - 1];
            if (cost < divided[j] || k == 1) {
                divided[j] = cost;
                choice[j - 1] = static_cast<std::uint8_t>(k);
            }
        }
    }
    const float as_leaf = leaf_cost(node, end);
    const float as_node = relative_area(node) * options_.node_cost + divided[options_.width];
    choice[0] = as_leaf <= as_node ? 1 : 0;
    costs[0] = std::min(as_leaf, as_node);
    for (std::uint32_t j = 2; j <= 7; ++j) {
        costs[j - 1] = costs[j - 2];
        if (j < options_.width && divided[j] < costs[j - 1])
            costs[j - 1] = divided[j];
        else if (j < options_.width)
            choice[j - 1] = 0;
    }
    return costs;
}

void Collapse::gather(std::uint32_t node, std::uint32_t roots, Children& children) const {
    while (roots > 1 && !tree_.nodes[node].is_leaf() && choice_[node][roots - 1] == 0)
        --roots;
    if (roots == 1 || tree_.nodes[node].is_leaf()) {
        children.node[children.count++] = node;
        return;
    }
    const std::uint32_t left = choice_[node][roots - 1];
    gather(node + 1, left, children);
    gather(tree_.nodes[node].right, roots - left, children);
}

Collapse::Children Collapse::children(std::uint32_t node) const {
    Children result;
    gather(node, options_.width, result);
    std::stable_sort(result.node.begin(), result.node.begin() + result.count,
                     [&](std::uint32_t a, std::uint32_t b) {
                         return half_area(tree_.nodes[a].box) > half_area(tree_.nodes[b].box);
                     });
    return result;
}

Collapse::Triangles Collapse::triangles(std::uint32_t leaf) const {
    Triangles result;
    // A subtree's nodes are consecutive; it ends where there are one more leaves than inner nodes.
    std::uint32_t open = 1;
    for (std::uint32_t i = leaf; open > 0; ++i) {
        if (tree_.nodes[i].is_leaf()) {
            result.id[result.count++] = tree_.nodes[i].triangle;
            --open;
        } else {
            ++open;
        }
    }
    std::sort(result.id.begin(), result.id.begin() + result.count);
    const auto* end = std::unique(result.id.begin(), result.id.begin() + result.count);
    result.count = static_cast<std::uint32_t>(end - result.id.begin());
    return result;
}

} // namespace macula::bvh
