// The recursive build (Stich, Friedrich and Dietrich 2009, "Spatial Splits in Bounding Volume
// Hierarchies").
//
// References lie in one array. A subtree owns a range of it with spare room behind for references
// that it divides: the budget of duplicates is dealt out from the root down, so which thread builds
// what, and when, leaves no trace. The node whose right child starts at slot i is inner node i.
#include "bvh/builder.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include "bvh/object_split.hpp"
#include "bvh/partition.hpp"
#include "bvh/spatial_split.hpp"

namespace macula::bvh {
namespace {

constexpr std::uint32_t kParallelSubtree = 4096;
constexpr std::uint32_t kLeafBit = 0x80000000u;
// Spatial splits are sought only where the children of the best object split overlap by this share
// of the node's area, and where taking the overlap's thickness off both children would lower the
// cost by that share. The second rule spares the search on fine meshes; small sets are tried
// anyway. Measured: neither costs more than 0.3 % of the SAH cost.
constexpr float kLeastOverlap = 0.05f;
constexpr float kLeastGain = 0.01f;
constexpr std::uint32_t kSmallSet = 16;
// Beyond, the error bound behind the margins of triangles does not hold (docs/arithmetic.md).
constexpr float kLargestDividedCoordinate = 0x1p30f;

struct Range {
    std::uint32_t begin, end, limit; // references lie in [begin, end), spare room in [end, limit)
    std::uint32_t size() const { return end - begin; }
    std::uint32_t spare() const { return limit - end; }
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
    Builder(ReferenceSet set, std::uint32_t capacity, const Geometry* geometry,
            const BuildOptions& options)
        : options_(options), geometry_(geometry), set_(std::move(set)), capacity_(capacity),
          inner_(std::make_unique_for_overwrite<InnerNode[]>(capacity)),
          least_overlap_(set_.box.half_area() * options.overlap_threshold) {}

    Tree run() {
        Tree tree;
        if (set_.count == 0)
            return tree;
        const Subtree root = build({0, set_.count, capacity_}, {set_.box, set_.centroids}, 0);
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

    std::span<Reference> references(const Range& range) {
        return {set_.references.get() + range.begin, range.size()};
    }

    Subtree build(const Range& range, const Subset& subset, std::uint32_t depth) {
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

    Halves split(const Range& range, const Subset& subset, std::uint32_t depth) {
        const auto levels = static_cast<std::uint32_t>(std::bit_width(range.size() - 1));
        if (depth + levels >= MACULA_MAX_DEPTH - 2)
            return split_in_the_middle(range);
        if (range.size() <= kSweepSize) {
            const std::uint32_t middle = range.begin + sweep_split(references(range));
            return {{range.begin, middle, middle}, {middle, range.end, range.end}, {}, {}};
        }
        const ObjectSplit object = find_object_split(references(range), subset, options_.bins);
        if (may_divide(range, subset, object)) {
            const SpatialSplit spatial =
                find_spatial_split(references(range), subset.box, *geometry_, options_.bins);
            const std::uint32_t divided = spatial.left_count + spatial.right_count - range.size();
            if (spatial.cost < object.cost && divided <= range.spare()) {
                if (const auto halves = split_in_space(range, spatial))
                    return *halves;
            }
        }
        return object.is_valid() ? split_by(range, object) : split_in_the_middle(range);
    }

    // The overlap criterion of section 4.5, and what else tells that a search is in vain.
    bool may_divide(const Range& range, const Subset& subset, const ObjectSplit& object) const {
        if (range.spare() == 0 || geometry_ == nullptr || !object.is_valid())
            return false;
        Box4 overlap = object.left;
        overlap.clip(object.right);
        const Float4 size = overlap.hi - overlap.lo;
        if (size[0] < 0.0f || size[1] < 0.0f || size[2] < 0.0f)
            return false;
        if (overlap.half_area() <= std::max(least_overlap_, kLeastOverlap * subset.box.half_area()))
            return false;
        return range.size() <= kSmallSet ||
               size[object.axis] * cost_per_thickness(object) >= kLeastGain * object.cost;
    }

    // How much the cost falls for each unit of length that the children lose along the split axis.
    static float cost_per_thickness(const ObjectSplit& object) {
        const std::uint32_t b = (object.axis + 1) % 3, c = (object.axis + 2) % 3;
        const Float4 left = object.left.hi - object.left.lo;
        const Float4 right = object.right.hi - object.right.lo;
        return (left[b] + left[c]) * static_cast<float>(object.left_count) +
               (right[b] + right[c]) * static_cast<float>(object.right_count);
    }

    Halves split_by(const Range& range, const ObjectSplit& object) {
        return deal_out(range, partition(references(range), [&](const Reference& reference) {
                            return object.goes_left(reference);
                        }));
    }

    // Nothing when all references came to lie on one side.
    std::optional<Halves> split_in_space(Range range, const SpatialSplit& spatial) {
        const std::uint32_t whole_end = range.end;
        for (std::uint32_t i = range.begin; i < whole_end && range.spare() > 0; ++i) {
            Reference& reference = set_.references[i];
            if (spatial.side(reference) != SpatialSplit::Side::both)
                continue;
            const Divided parts = divide(reference, spatial, *geometry_);
            reference = parts.left;
            set_.references[range.end++] = parts.right;
        }
        const Partition parts = partition(references(range), [&](const Reference& reference) {
            return spatial.side(reference) != SpatialSplit::Side::right;
        });
        if (parts.left_count == 0 || parts.left_count == range.size())
            return std::nullopt;
        return deal_out(range, parts);
    }

    // Shares the spare room between the halves as far as they can use it: large boxes gain most.
    Halves deal_out(const Range& range, const Partition& parts) {
        const std::uint32_t middle = range.begin + parts.left_count;
        const auto weight = [&](const Subset& subset, std::uint32_t count) {
            const float area = subset.box.half_area();
            return area > least_overlap_ ? area * std::sqrt(static_cast<double>(count)) : 0.0;
        };
        const double left = weight(parts.left, parts.left_count);
        const double right = weight(parts.right, range.end - middle);
        const auto left_spare =
            left > 0.0 ? static_cast<std::uint32_t>(range.spare() * (left / (left + right))) : 0u;
        const Range right_range = move_up({middle, range.end, range.limit}, left_spare);
        return {{range.begin, middle, middle + left_spare}, right_range, parts.left, parts.right};
    }

    // Moves references by `distance` <= their spare room; as few as possible are touched.
    Range move_up(const Range& range, std::uint32_t distance) {
        const auto begin = set_.references.get() + range.begin;
        const std::uint32_t moved = std::min(distance, range.size());
        std::copy_n(begin, moved, begin + std::max(distance, range.size()));
        return {range.begin + distance, range.end + distance, range.limit};
    }

    // Where no split separates the references, or the tree would become too deep.
    Halves split_in_the_middle(const Range& range) {
        Halves halves{};
        const std::uint32_t middle = range.begin + range.size() / 2;
        halves.left = {range.begin, middle, middle};
        halves.right = {middle, range.end, range.end};
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
            node.right = 0;
            node.triangle = reference.triangle();
            return;
        }
        const InnerNode& inner = inner_[subtree.node];
        node.right = index + 2 * inner.left.references;
        node.triangle = 0;
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
    const Geometry* geometry_;
    ReferenceSet set_;
    std::uint32_t capacity_;
    std::unique_ptr<InnerNode[]> inner_;
    float least_overlap_;
};

void validate(const Geometry& geometry, const BuildOptions& options) {
    if (options.bins < 2 || options.bins > kMostBins)
        throw std::invalid_argument("BVH build: bins is " + std::to_string(options.bins) +
                                    "; it must be from 2 to 128");
    if (!(options.duplication_budget >= 0.0f && options.duplication_budget <= 4.0f))
        throw std::invalid_argument("BVH build: duplication_budget is " +
                                    std::to_string(options.duplication_budget) +
                                    "; it must be from 0 to 4");
    if (geometry.triangles.size() >= (std::size_t{1} << 28))
        throw std::invalid_argument("BVH build: a mesh of " +
                                    std::to_string(geometry.triangles.size()) +
                                    " triangles; at most 2^28 - 1 are supported");
}

// Triangles, and room for duplicates if any may be made.
std::uint32_t capacity_for(const Geometry& geometry, const BuildOptions& options) {
    const auto count = static_cast<double>(geometry.triangles.size());
    const double extra = options.spatial_splits ? count * options.duplication_budget : 0.0;
    return static_cast<std::uint32_t>(std::min(count + extra, 0x1p30));
}

Tree build_mesh(const Geometry& geometry, const BuildOptions& options) {
    const std::uint32_t capacity = capacity_for(geometry, options);
    ReferenceSet set = make_references(geometry, capacity);
    float largest = 0.0f;
    for (int axis = 0; axis < 3; ++axis)
        largest = std::max({largest, std::fabs(set.box.lo[axis]), std::fabs(set.box.hi[axis])});
    const bool divide = options.spatial_splits && largest < kLargestDividedCoordinate;
    return build_tree(std::move(set), capacity, divide ? &geometry : nullptr, options);
}

} // namespace

Tree build_tree(ReferenceSet references, std::uint32_t capacity, const Geometry* geometry,
                const BuildOptions& options) {
    return Builder(std::move(references), capacity, geometry, options).run();
}

Tree build(const Geometry& geometry, const BuildOptions& options) {
    validate(geometry, options);
    const auto start = std::chrono::steady_clock::now();
    Tree tree;
    tbb::task_arena arena(options.threads == 0 ? tbb::task_arena::automatic
                                               : static_cast<int>(options.threads));
    arena.execute([&] { tree = build_mesh(geometry, options); });
    tree.build_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return tree;
}

} // namespace macula::bvh
