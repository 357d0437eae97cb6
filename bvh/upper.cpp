// The upper level: where instances stand, and the tree over them.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "bvh/builder.hpp"
#include "bvh/layout_formats.hpp"

namespace macula::bvh {
namespace {

using Rows = float[3][4];

bool is_identity(const Rows& m) {
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            if (m[row][column] != (row == column ? 1.0f : 0.0f))
                return false;
        }
    }
    return true;
}

// Inverse of an affine transform by cofactors, in double precision.
void invert(const Rows& m, Rows& inverse) {
    double cofactor[3][3];
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
            cofactor[i][j] = double{m[a][c]} * m[b][d] - double{m[a][d]} * m[b][c];
        }
    }
    const double determinant =
        m[0][0] * cofactor[0][0] + m[0][1] * cofactor[0][1] + m[0][2] * cofactor[0][2];
    double largest = 0.0;
    bool finite = true;
    for (const auto& row : m) {
        for (int j = 0; j < 4; ++j)
            finite = finite && std::isfinite(row[j]);
        for (int j = 0; j < 3; ++j)
            largest = std::max(largest, std::fabs(double{row[j]}));
    }
    if (!finite || !(std::fabs(determinant) > 1e-12 * largest * largest * largest))
        throw std::invalid_argument("BVH instance: the transform is singular or not finite "
                                    "(determinant " +
                                    std::to_string(determinant) + ")");
    for (int i = 0; i < 3; ++i) {
        double moved = 0.0;
        for (int j = 0; j < 3; ++j) {
            const double x = cofactor[j][i] / determinant;
            inverse[i][j] = static_cast<float>(x);
            moved -= x * m[j][3];
        }
        inverse[i][3] = static_cast<float>(moved);
    }
}

// Interval arithmetic over the mesh's box, widened by far more than the rounding of transformed
// rays and of the transform itself.
void bound(const Rows& m, const Box& mesh_box, shared::Instance& instance) {
    double lo[3], hi[3], reach = 0.0;
    for (int row = 0; row < 3; ++row) {
        lo[row] = hi[row] = m[row][3];
        double size = std::fabs(lo[row]);
        for (int axis = 0; axis < 3; ++axis) {
            const double a = double{m[row][axis]} * mesh_box.lo[axis];
            const double b = double{m[row][axis]} * mesh_box.hi[axis];
            lo[row] += std::min(a, b);
            hi[row] += std::max(a, b);
            size += std::max(std::fabs(a), std::fabs(b));
        }
        reach = std::max(reach, size);
    }
    for (int row = 0; row < 3; ++row) {
        instance.lo[row] = static_cast<float>(lo[row] - 0x1p-17 * reach);
        instance.hi[row] = static_cast<float>(hi[row] + 0x1p-17 * reach);
    }
}

bool is_empty(const shared::Instance& instance) {
    return !(instance.lo[0] <= instance.hi[0]);
}

int upper_child(const Tree& tree, std::uint32_t node, std::vector<shared::BinaryNode>& nodes) {
    if (tree.nodes[node].is_leaf())
        return static_cast<int>(~(tree.nodes[node].triangle << MACULA_LEAF_COUNT_BITS | 1u));
    const std::size_t index = nodes.size();
    nodes.emplace_back();
    const std::uint32_t right = tree.nodes[node].right;
    const Child children[2] = {{tree.nodes[node + 1].box, upper_child(tree, node + 1, nodes)},
                               {tree.nodes[right].box, upper_child(tree, right, nodes)}};
    write_node(nodes[index], tree.nodes[node].box, children);
    return static_cast<int>(index);
}

ReferenceSet boxes_of(std::span<const shared::Instance> instances) {
    ReferenceSet set;
    set.references = std::make_unique_for_overwrite<Reference[]>(instances.size());
    for (std::uint32_t i = 0; i < instances.size(); ++i) {
        const shared::Instance& instance = instances[i];
        if (is_empty(instance))
            continue;
        const Reference reference = {
            {instance.lo[0], instance.lo[1], instance.lo[2], 0.0f},
            {instance.hi[0], instance.hi[1], instance.hi[2], std::bit_cast<float>(i)}};
        set.references[set.count++] = reference;
        set.box.add(reference.box());
        set.centroids.add(reference.centroid());
    }
    return set;
}

} // namespace

void place(shared::Instance& instance, const Box& mesh_box) {
    invert(instance.world_from_object, instance.object_from_world);
    instance.identity = is_identity(instance.world_from_object) ? 1u : 0u;
    const bool empty = !(mesh_box.lo[0] <= mesh_box.hi[0]);
    if (empty || instance.identity != 0) {
        std::copy_n(mesh_box.lo, 3, instance.lo);
        std::copy_n(mesh_box.hi, 3, instance.hi);
    } else {
        bound(instance.world_from_object, mesh_box, instance);
    }
}

std::vector<shared::BinaryNode> build_upper(std::span<const shared::Instance> instances) {
    if (instances.size() >= (std::size_t{1} << (31 - MACULA_LEAF_COUNT_BITS)))
        throw std::invalid_argument("BVH upper level: " + std::to_string(instances.size()) +
                                    " instances; at most 2^27 - 1 are supported");
    const auto count = static_cast<std::uint32_t>(instances.size());
    const Tree tree = build_tree(boxes_of(instances), count, nullptr, {});
    std::vector<shared::BinaryNode> nodes;
    if (tree.nodes.empty()) {
        write_node(nodes.emplace_back(), kEmptyBox, {});
    } else if (tree.nodes[0].is_leaf()) {
        const Child only = {tree.nodes[0].box, upper_child(tree, 0, nodes)};
        write_node(nodes.emplace_back(), only.box, {&only, 1});
    } else {
        nodes.reserve(tree.nodes.size() / 2);
        upper_child(tree, 0, nodes);
    }
    return nodes;
}

} // namespace macula::bvh
