// The recursive build (Stich, Friedrich and Dietrich 2009, "Spatial Splits in Bounding Volume
// Hierarchies").
//
// References lie in one array. A subtree owns a range of it, so that inner nodes need no
// allocation: the node whose right child starts at slot i is node i. Which thread builds what
// leaves no trace.
#include <bit>
#include <chrono>
#include <stdexcept>
#include <string>

#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include "bvh/builder.hpp"
#include "bvh/object_split.hpp"
#include "bvh/partition.hpp"

namespace macula::bvh {
namespace {

constexpr std::uint32_t kParallelSubtree = 4096;
constexpr std::uint32_t kLeafBit = 0x80000000u;

struct Range {
    std::uint32_t begin, end;
    std::uint32_t size() const { return end - begin; }
};

// kLeafBit | slot of a reference, or the index of an inner node.
struct Subtree {
    std::uint32_t node = 0;
    std::uint32_t references = 0;
};

struct InnerNode {
    Subtree left, right;
};

class Builder {
  public:
    Builder(ReferenceSet set, const BuildOptions& options)
        : options_(options), set_(std::move(set)),
          inner_(std::make_unique_for_overwrite<InnerNode[]>(set_.count)) {}

    Tree run() {
        Tree tree;
        if (set_.count == 0)
            return tree;
        const Subtree root = build({0, set_.count}, {set_.box, set_.centroids}, 0);
        tree.references = root.references;
        tree.nodes.resize(std::size_t{2} * root.references - 1);
        emit(root, 0, tree);
        return tree;
    }

  private:
    struct Halves {
        Range left, right;
        Subset left_subset, right_subset;
    };

    std::span<Reference> references(Range range) {
        return {set_.references.get() + range.begin, range.size()};
    }

    Subtree build(Range range, const Subset& subset, std::uint32_t depth) {
        if (range.size() == 1)
            return {kLeafBit | range.begin, 1};
        const Halves halves = split(range, subset, depth);
        InnerNode& node = inner_[halves.right.begin];
        const auto build_left = [&] {
            node.left = build(halves.left, halves.left_subset, depth + 1);
        };
        const auto build_right = [&] {
            node.right = build(halves.right, halves.right_subset, depth + 1);
        };
        if (range.size() > kParallelSubtree) {
            tbb::parallel_invoke(build_left, build_right);
        } else {
            build_left();
            build_right();
        }
        return {halves.right.begin, node.left.references + node.right.references};
    }

    Halves split(Range range, const Subset& subset, std::uint32_t depth) {
        const auto levels = static_cast<std::uint32_t>(std::bit_width(range.size() - 1));
        if (depth + levels >= MACULA_MAX_DEPTH - 2)
            return split_in_the_middle(range);
        if (range.size() <= kSweepSize) {
            const std::uint32_t middle = range.begin + sweep_split(references(range));
            return {{range.begin, middle}, {middle, range.end}, {}, {}};
        }
        const ObjectSplit object = find_object_split(references(range), subset, options_.bins);
        if (!object.is_valid())
            return split_in_the_middle(range);
        const Partition parts =
            partition(references(range), [&](const Reference& r) { return object.goes_left(r); });
        const std::uint32_t middle = range.begin + parts.left_count;
        return {{range.begin, middle}, {middle, range.end}, parts.left, parts.right};
    }

    // Where no split separates the references, or the tree would become too deep.
    Halves split_in_the_middle(Range range) {
        Halves halves{};
        const std::uint32_t middle = range.begin + range.size() / 2;
        halves.left = {range.begin, middle};
        halves.right = {middle, range.end};
        for (const Reference& reference : references(halves.left))
            halves.left_subset.add(reference);
        for (const Reference& reference : references(halves.right))
            halves.right_subset.add(reference);
        return halves;
    }

    // Writes a subtree in depth-first order from tree.nodes[index] on.
    void emit(Subtree subtree, std::uint32_t index, Tree& tree) const {
        TreeNode& node = tree.nodes[index];
        if ((subtree.node & kLeafBit) != 0) {
            const Reference& reference = set_.references[subtree.node & ~kLeafBit];
            for (int axis = 0; axis < 3; ++axis) {
                node.box.lo[axis] = reference.lo[axis] - reference.margin();
                node.box.hi[axis] = reference.hi[axis] + reference.margin();
            }
            node.triangle = reference.triangle();
            return;
        }
        const InnerNode& inner = inner_[subtree.node];
        node.right = index + 2 * inner.left.references;
        const auto emit_left = [&] { emit(inner.left, index + 1, tree); };
        const auto emit_right = [&] { emit(inner.right, node.right, tree); };
        if (subtree.references > kParallelSubtree) {
            tbb::parallel_invoke(emit_left, emit_right);
        } else {
            emit_left();
            emit_right();
        }
        const Box &left = tree.nodes[index + 1].box, &right = tree.nodes[node.right].box;
        for (int axis = 0; axis < 3; ++axis) {
            node.box.lo[axis] = std::min(left.lo[axis], right.lo[axis]);
            node.box.hi[axis] = std::max(left.hi[axis], right.hi[axis]);
        }
    }

    const BuildOptions& options_;
    ReferenceSet set_;
    std::unique_ptr<InnerNode[]> inner_;
};

void validate(const Geometry& geometry, const BuildOptions& options) {
    if (options.bins < 2 || options.bins > kMostBins)
        throw std::invalid_argument("BVH build: bins is " + std::to_string(options.bins) +
                                    "; it must be from 2 to 256");
    if (geometry.triangles.size() >= (std::size_t{1} << 29))
        throw std::invalid_argument("BVH build: a mesh of " +
                                    std::to_string(geometry.triangles.size()) +
                                    " triangles; at most 2^29 - 1 are supported");
}

} // namespace

Tree build_tree(ReferenceSet references, const BuildOptions& options) {
    return Builder(std::move(references), options).run();
}

Tree build(const Geometry& geometry, const BuildOptions& options) {
    validate(geometry, options);
    const auto start = std::chrono::steady_clock::now();
    Tree tree;
    tbb::task_arena arena(options.threads == 0 ? tbb::task_arena::automatic
                                               : static_cast<int>(options.threads));
    arena.execute(
        [&] { tree = build_tree(make_references(geometry, geometry.triangles.size()), options); });
    tree.build_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return tree;
}

} // namespace macula::bvh
