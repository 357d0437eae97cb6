// The SBVH: one builder, several layouts. No OpenCL here. A mesh's triangles go in, a binary tree
// of triangle references comes out, and the layouts of shared/bvh.h are derived from that tree.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bvh/array.hpp"
#include "shared/bvh.h"

namespace macula::bvh {

using shared::uint;

// Positions in object space, packed xyz; every index < positions.size() / 3. Coordinates must be
// finite and below 1e18 in size. `masked` is empty or has one entry a triangle, non-zero where the
// triangle carries an alpha mask.
struct Geometry {
    std::span<const float> positions;
    std::span<const std::array<std::uint32_t, 3>> triangles;
    std::span<const std::uint8_t> masked;
};

struct Box {
    float lo[3], hi[3];
};

struct BuildOptions {
    bool spatial_splits = true;
    float overlap_threshold = 1e-4f; // alpha of Stich et al. 2009, section 4.5 (there 1e-5)
    float duplication_budget = 1.0f; // most extra references, as a fraction of the triangles; much
                                     // of it ends where it is not needed: about 0.2 is used
    float traversal_cost = 1.0f;     // SAH, per inner node
    float intersection_cost = 1.0f;  // SAH, per triangle reference
    std::uint32_t bins = 128;        // most bins per axis, 2..128; small nodes use fewer
    std::uint32_t threads = 0;       // 0: all
    bool operator==(const BuildOptions&) const = default;
};

// Binary tree over references, in depth-first order: node 0 is the root, the left child of node i
// is i + 1. A leaf holds one reference. Boxes carry the margins of lib/triangle.h.
struct TreeNode {
    Box box;
    std::uint32_t right;    // index of the right child; 0: a leaf
    std::uint32_t triangle; // of a leaf
    bool is_leaf() const { return right == 0; }
};

struct Tree {
    Array<TreeNode> nodes;
    std::uint32_t references = 0;
    double build_seconds = 0.0;
};

// Throws std::invalid_argument on indices out of range or non-finite positions. An empty geometry
// gives an empty tree.
Tree build(const Geometry& geometry, const BuildOptions& options = {});

enum class Layout : std::uint8_t {
    binary,       // BinaryNode, Triangle leaves
    skip,         // SkipNode, Triangle leaves
    wide8_single, // Wide8Node, Triangle leaves of at most 2
    wide8_block,  // Wide8Node, TriangleBlock8 leaves
    quantized8,   // Quantized8Node, Triangle leaves
};
inline constexpr std::array kLayouts = {Layout::binary, Layout::skip, Layout::wide8_single,
                                        Layout::wide8_block, Layout::quantized8};
const char* name(Layout layout);

// One mesh in one layout: the bytes that go to the device. References are relative to the start
// (0) of both arrays; rebase() moves them when meshes are concatenated.
struct LaidOut {
    Layout layout = Layout::binary;
    std::vector<std::byte> nodes;     // array of the layout's node struct
    std::vector<std::byte> triangles; // array of Triangle or TriangleBlock8
    int root = 0;                     // child reference; always an inner node
    std::uint32_t node_count = 0;
    std::uint32_t triangle_entries = 0; // Triangles or TriangleBlock8s
    Box box{};                          // of the whole mesh
};

LaidOut lay_out(const Tree& tree, const Geometry& geometry, Layout layout);

// Adds `first_node` and `first_triangle` (in entries) to every reference.
void rebase(LaidOut& mesh, std::uint32_t first_node, std::uint32_t first_triangle);

struct Statistics {
    double sah = 0.0;         // cost of the binary tree, root area normalised
    double duplication = 1.0; // references / triangles
    std::uint32_t depth = 0;
    std::uint32_t nodes = 0;
    double bytes_per_triangle = 0.0;
    double build_seconds = 0.0;
};
Statistics statistics(const Tree& tree, const Geometry& geometry, const BuildOptions& options = {});

// The upper level: a BinaryNode tree over instance boxes, leaves ~((instance << 4) | 1). A single
// instance gives one node whose second child is empty. Rebuilt each frame in which something moves.
std::vector<shared::BinaryNode> build_upper(std::span<const shared::Instance> instances);

// Fills lo/hi of an instance from its mesh's box and world_from_object, conservatively, and
// object_from_world from world_from_object (throws std::invalid_argument when singular).
void place(shared::Instance& instance, const Box& mesh_box);

// Disk cache (after Smith et al. 2014): keyed by the geometry's content and the build options,
// versioned, checksummed, written to a temporary name and renamed, memory-mapped on load.
struct CacheResult {
    Tree tree;
    bool from_cache = false;
    std::string note; // why a cache file was not used, empty when none existed or it was used
};
CacheResult build_cached(const Geometry& geometry, const BuildOptions& options,
                         const std::filesystem::path& directory);

} // namespace macula::bvh
