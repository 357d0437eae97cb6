// Layouts of nodes that refer to their children by index: binary, wide8 and quantized8.
#include <algorithm>
#include <stdexcept>
#include <string>

#include <tbb/parallel_for.h>

#include "bvh/collapse.hpp"
#include "bvh/layout_formats.hpp"
#include "bvh/layout_skip.hpp"

namespace macula::bvh {
namespace {

// Subtrees of at most this many tree nodes are written by one thread.
constexpr std::uint32_t kChunkNodes = 32768;
// First index and count of a leaf share 31 bits with the sign.
constexpr std::uint64_t kMostEntries = std::uint64_t{1} << (31 - MACULA_LEAF_COUNT_BITS);

// Indices within the node and triangle arrays.
struct Place {
    std::uint64_t node = 0, entry = 0;
};

template <typename Node, typename Entry>
class Writer {
  public:
    Writer(const Tree& tree, const Geometry& geometry, const CollapseOptions& options)
        : tree_(tree), geometry_(geometry), collapse_(tree, options) {}

    // The nodes near the root come first, then the subtrees below them one after another, each in
    // depth-first order. Sizes are counted before anything is allocated.
    LaidOut run(Layout layout) {
        LaidOut result;
        result.layout = layout;
        if (tree_.nodes.empty()) {
            nodes_ = allocate<Node>(result.nodes, 1);
            write_node(nodes_[0], kEmptyBox, {});
            result.node_count = 1;
            result.box = kEmptyBox;
            return result;
        }
        result.box = tree_.nodes[0].box;
        if (collapse_.is_leaf(0)) {
            write_only_leaf(result);
            return result;
        }
        Place size;
        plan(0, size);
        count_chunks(size);
        if (size.entry >= kMostEntries || size.node >= (std::uint64_t{1} << 31))
            throw std::invalid_argument(std::string("BVH layout ") + name(layout) + ": " +
                                        std::to_string(size.entry) +
                                        " triangle entries are more than 2^27 - 1");
        nodes_ = allocate<Node>(result.nodes, size.node);
        entries_ = allocate<Entry>(result.triangles, size.entry);
        result.node_count = static_cast<std::uint32_t>(size.node);
        result.triangle_entries = static_cast<std::uint32_t>(size.entry);
        tbb::parallel_for(std::size_t{0}, chunks_.size(), [&](std::size_t i) {
            Place place = chunks_[i].place;
            write(chunks_[i].root, place, nullptr);
        });
        Place place;
        const Chunk* next = chunks_.data();
        write(0, place, &next);
        return result;
    }

  private:
    struct Chunk {
        std::uint32_t root = 0;
        Place place;
    };

    template <typename T>
    static T* allocate(std::vector<std::byte>& bytes, std::uint64_t count) {
        bytes.resize(count * sizeof(T));
        return reinterpret_cast<T*>(bytes.data());
    }

    static int leaf_reference(std::uint64_t first, std::uint32_t count) {
        return static_cast<int>(
            ~static_cast<std::uint32_t>(first << MACULA_LEAF_COUNT_BITS | count));
    }

    std::uint32_t leaf_entries(std::uint32_t leaf) const {
        return entries_for(entries_, collapse_.triangles(leaf).count);
    }

    bool is_chunk(std::uint32_t node) const {
        std::uint32_t last = node;
        while (!tree_.nodes[last].is_leaf())
            last = tree_.nodes[last].right;
        return last - node < kChunkNodes;
    }

    void write_only_leaf(LaidOut& result) {
        const auto triangles = collapse_.triangles(0);
        const std::uint32_t count = entries_for(entries_, triangles.count);
        nodes_ = allocate<Node>(result.nodes, 1);
        entries_ = allocate<Entry>(result.triangles, count);
        write_leaf(entries_, geometry_, {triangles.id.data(), triangles.count});
        const Child child{result.box, leaf_reference(0, count)};
        write_node(nodes_[0], result.box, {&child, 1});
        result.node_count = 1;
        result.triangle_entries = count;
    }

    // Lists the chunks and counts what lies above them.
    void plan(std::uint32_t node, Place& size) {
        ++size.node;
        const auto children = collapse_.children(node);
        for (std::uint32_t i = 0; i < children.count; ++i) {
            const std::uint32_t child = children.node[i];
            if (collapse_.is_leaf(child))
                size.entry += leaf_entries(child);
            else if (is_chunk(child))
                chunks_.push_back({child, {}});
            else
                plan(child, size);
        }
    }

    void count(std::uint32_t node, Place& size) const {
        ++size.node;
        const auto children = collapse_.children(node);
        for (std::uint32_t i = 0; i < children.count; ++i) {
            if (collapse_.is_leaf(children.node[i]))
                size.entry += leaf_entries(children.node[i]);
            else
                count(children.node[i], size);
        }
    }

    void count_chunks(Place& size) {
        tbb::parallel_for(std::size_t{0}, chunks_.size(),
                          [&](std::size_t i) { count(chunks_[i].root, chunks_[i].place); });
        for (Chunk& chunk : chunks_) {
            const Place own = chunk.place;
            chunk.place = size;
            size.node += own.node;
            size.entry += own.entry;
        }
    }

    // Writes a subtree from `place` on; `next_chunk` is null within a chunk.
    int write(std::uint32_t node, Place& place, const Chunk** next_chunk) {
        const std::uint64_t index = place.node++;
        const auto children = collapse_.children(node);
        std::array<Child, 8> written;
        for (std::uint32_t i = 0; i < children.count; ++i) {
            const std::uint32_t child = children.node[i];
            written[i].box = tree_.nodes[child].box;
            if (collapse_.is_leaf(child))
                written[i].reference = write_leaf_at(child, place);
            else if (next_chunk != nullptr && is_chunk(child))
                written[i].reference = static_cast<int>((*next_chunk)++->place.node);
            else
                written[i].reference = write(child, place, next_chunk);
        }
        write_node(nodes_[index], tree_.nodes[node].box, {written.data(), children.count});
        return static_cast<int>(index);
    }

    int write_leaf_at(std::uint32_t leaf, Place& place) {
        const auto triangles = collapse_.triangles(leaf);
        const std::uint32_t count = entries_for(entries_, triangles.count);
        write_leaf(entries_ + place.entry, geometry_, {triangles.id.data(), triangles.count});
        const int reference = leaf_reference(place.entry, count);
        place.entry += count;
        return reference;
    }

    const Tree& tree_;
    const Geometry& geometry_;
    Collapse collapse_;
    std::vector<Chunk> chunks_;
    Node* nodes_ = nullptr;
    Entry* entries_ = nullptr;
};

// Costs relative to visiting a node, measured on a CPU. A binary node tests two boxes, a wide one
// eight; a block tests eight triangles at once.
constexpr CollapseOptions kBinary = {2, 4, 1, 1.0f, 1.0f};
constexpr CollapseOptions kWideSingle = {8, 2, 1, 1.0f, 0.7f};
constexpr CollapseOptions kWideBlock = {8, 8, 8, 1.0f, 0.7f};
constexpr CollapseOptions kQuantized = {8, 3, 1, 1.0f, 0.7f};

} // namespace

const char* name(Layout layout) {
    switch (layout) {
    case Layout::binary:
        return "binary";
    case Layout::skip:
        return "skip";
    case Layout::wide8_single:
        return "wide8_single";
    case Layout::wide8_block:
        return "wide8_block";
    case Layout::quantized8:
        return "quantized8";
    }
    return "unknown";
}

LaidOut lay_out(const Tree& tree, const Geometry& geometry, Layout layout) {
    using shared::BinaryNode, shared::Quantized8Node, shared::Triangle, shared::TriangleBlock8,
        shared::Wide8Node;
    switch (layout) {
    case Layout::binary:
        return Writer<BinaryNode, Triangle>(tree, geometry, kBinary).run(layout);
    case Layout::skip:
        return lay_out_skip(tree, geometry, kBinary);
    case Layout::wide8_single:
        return Writer<Wide8Node, Triangle>(tree, geometry, kWideSingle).run(layout);
    case Layout::wide8_block:
        return Writer<Wide8Node, TriangleBlock8>(tree, geometry, kWideBlock).run(layout);
    case Layout::quantized8:
        return Writer<Quantized8Node, Triangle>(tree, geometry, kQuantized).run(layout);
    }
    throw std::invalid_argument("BVH layout: unknown layout");
}

} // namespace macula::bvh
