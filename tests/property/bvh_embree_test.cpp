// The anchor of tree quality: our SAH cost against Embree's, by the same function. Embree's tree is
// that of rtcBuildBVH at RTC_BUILD_QUALITY_HIGH, with spatial splits. Build times are printed only:
// they say little on a busy machine.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include <gtest/gtest.h>

#include "bvh/clip.hpp"
#include "scenes/load.hpp"
#include "tests/support/bvh_scenes.hpp"

#ifdef MACULA_WITH_BENCH
#include <embree3/rtcore.h>
#endif

namespace macula::bvh::test {
namespace {

#ifdef MACULA_WITH_BENCH

// A node of Embree's tree; a leaf holds one reference.
struct EmbreeNode {
    Box box[2] = {};
    EmbreeNode* child[2] = {};
    Box leaf_box = {};
    std::uint32_t triangle = 0;
    bool is_leaf() const { return child[0] == nullptr; }
};

Box box_of(const RTCBounds& b) {
    return {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
}

EmbreeNode* allocate(RTCThreadLocalAllocator allocator) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(EmbreeNode), 16)) EmbreeNode;
}

void* create_node(RTCThreadLocalAllocator allocator, unsigned, void*) {
    return allocate(allocator);
}

void set_children(void* node, void** children, unsigned count, void*) {
    for (unsigned i = 0; i < count; ++i)
        static_cast<EmbreeNode*>(node)->child[i] = static_cast<EmbreeNode*>(children[i]);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
    for (unsigned i = 0; i < count; ++i)
        static_cast<EmbreeNode*>(node)->box[i] = box_of(*bounds[i]);
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives,
                  std::size_t, void*) {
    EmbreeNode* leaf = allocate(allocator);
    const RTCBuildPrimitive& p = primitives[0];
    leaf->leaf_box = {{p.lower_x, p.lower_y, p.lower_z}, {p.upper_x, p.upper_y, p.upper_z}};
    leaf->triangle = p.primID;
    return leaf;
}

void write_bounds(const Box4& part, const RTCBuildPrimitive& p, RTCBounds& bounds) {
    bounds.lower_x = std::max(part.lo[0], p.lower_x);
    bounds.lower_y = std::max(part.lo[1], p.lower_y);
    bounds.lower_z = std::max(part.lo[2], p.lower_z);
    bounds.upper_x = std::min(part.hi[0], p.upper_x);
    bounds.upper_y = std::min(part.hi[1], p.upper_y);
    bounds.upper_z = std::min(part.hi[2], p.upper_z);
}

void split_primitive(const RTCBuildPrimitive* p, unsigned axis, float plane, RTCBounds* left,
                     RTCBounds* right, void* geometry) {
    const ClippedTriangle triangle(*static_cast<const Geometry*>(geometry), p->primID);
    Box4 low = triangle.crossing(axis, plane), high = low;
    for (const Float4 v : triangle.v)
        (v[axis] <= plane ? low : high).add(Float4(v));
    write_bounds(low, *p, *left);
    write_bounds(high, *p, *right);
}

std::vector<RTCBuildPrimitive> primitives_of(const Geometry& geometry) {
    const auto count = static_cast<std::uint32_t>(geometry.triangles.size());
    const ReferenceSet set = make_references(geometry, count);
    std::vector<RTCBuildPrimitive> primitives(std::size_t{2} * count); // room for splits
    for (std::uint32_t i = 0; i < count; ++i) {
        const Reference& r = set.references[i];
        primitives[i] = {r.lo[0], r.lo[1], r.lo[2], 0, r.hi[0], r.hi[1], r.hi[2], i};
    }
    return primitives;
}

std::uint32_t convert(const EmbreeNode& node, const Box& box, Tree& tree) {
    const auto index = static_cast<std::uint32_t>(tree.nodes.size());
    tree.nodes.push_back({box, 0, node.triangle});
    if (node.is_leaf()) {
        tree.nodes[index].box = node.leaf_box;
        ++tree.references;
        return index;
    }
    convert(*node.child[0], node.box[0], tree);
    const std::uint32_t right = convert(*node.child[1], node.box[1], tree);
    tree.nodes[index].right = right;
    return index;
}

Tree build_with_embree(const Geometry& geometry) {
    const RTCDevice device = rtcNewDevice(nullptr);
    const RTCBVH bvh = rtcNewBVH(device);
    std::vector<RTCBuildPrimitive> primitives = primitives_of(geometry);
    Geometry copy = geometry;
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.byteSize = sizeof arguments;
    arguments.buildQuality = RTC_BUILD_QUALITY_HIGH;
    arguments.maxBranchingFactor = 2;
    arguments.maxDepth = 1024;
    arguments.minLeafSize = 1;
    arguments.maxLeafSize = 1;
    arguments.bvh = bvh;
    arguments.primitives = primitives.data();
    arguments.primitiveCount = geometry.triangles.size();
    arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = create_node;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    arguments.createLeaf = create_leaf;
    arguments.splitPrimitive = split_primitive;
    arguments.userPtr = &copy;
    const auto start = std::chrono::steady_clock::now();
    const auto* root = static_cast<const EmbreeNode*>(rtcBuildBVH(&arguments));
    Tree tree;
    tree.build_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    Box box = root->leaf_box;
    for (int axis = 0; axis < 3 && !root->is_leaf(); ++axis) {
        box.lo[axis] = std::min(root->box[0].lo[axis], root->box[1].lo[axis]);
        box.hi[axis] = std::max(root->box[0].hi[axis], root->box[1].hi[axis]);
    }
    convert(*root, box, tree);
    rtcReleaseBVH(bvh);
    rtcReleaseDevice(device);
    return tree;
}

// How a scene's build by Embree takes the time that users of Embree know: scene commit.
double embree_commit_seconds(const Geometry& geometry) {
    const RTCDevice device = rtcNewDevice(nullptr);
    const RTCScene scene = rtcNewScene(device);
    const RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               geometry.positions.data(), 0, 12, geometry.positions.size() / 3);
    rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               geometry.triangles.data(), 0, 12, geometry.triangles.size());
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene, mesh);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    const auto start = std::chrono::steady_clock::now();
    rtcCommitScene(scene);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    rtcReleaseGeometry(mesh);
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
    return seconds;
}

// Our boxes carry the margins of lib/triangle.h, Embree's do not: the comparison is to our loss.
void expect_no_worse_than_embree(const char* name, const Soup& soup) {
    const Geometry geometry = soup.geometry();
    const Statistics ours = statistics(build(geometry), geometry);
    const Statistics theirs = statistics(build_with_embree(geometry), geometry);
    std::printf("%s: %zu triangles; SAH %.3f (Embree %.3f), duplication %.3f (%.3f), depth %u "
                "(%u), build %.3f s (Embree scene %.3f s)\n",
                name, soup.triangles.size(), ours.sah, theirs.sah, ours.duplication,
                theirs.duplication, ours.depth, theirs.depth, ours.build_seconds,
                embree_commit_seconds(geometry));
    EXPECT_LE(ours.sah, theirs.sah) << name;
}

// All meshes of a scene, each once and where it is modelled.
Soup soup_of(const std::string& name, std::uint32_t size = 0) {
    scene::LoadOptions options;
    options.textures = false;
    options.size = size;
    const scene::Scene scene = scene::load(name, options);
    Soup soup;
    for (const scene::Mesh& mesh : scene.meshes) {
        const auto first = static_cast<std::uint32_t>(soup.positions.size() / 3);
        for (const glm::vec3& p : mesh.positions)
            soup.add_vertex(p.x, p.y, p.z);
        for (const glm::uvec3& t : mesh.triangles)
            soup.triangles.push_back({first + t.x, first + t.y, first + t.z});
    }
    return soup;
}

void compare_shared(const std::string& path) {
    const std::filesystem::path file = std::filesystem::path(MACULA_SHARED_DIR) / "scenes" / path;
    if (!std::filesystem::exists(file))
        GTEST_SKIP() << file << " is not there";
    expect_no_worse_than_embree(path.c_str(), soup_of(file.string()));
}

TEST(BvhEmbree, RandomSoup) {
    expect_no_worse_than_embree("random soup", random_soup(50000, 0.05f, 1));
}

TEST(BvhEmbree, Needles) {
    expect_no_worse_than_embree("needles", needles(10000, 2));
}

TEST(BvhEmbree, Atrium) {
    expect_no_worse_than_embree("atrium", soup_of("atrium"));
}

TEST(BvhEmbree, CrytekSponza) {
    compare_shared("sponza_crytek/sponza.obj");
}

TEST(BvhEmbree, Sibenik) {
    compare_shared("sibenik/sibenik.obj");
}

TEST(BvhEmbree, Bunny) {
    compare_shared("bunny/bunny_69k.obj");
}

#else

TEST(BvhEmbree, Compare) {
    GTEST_SKIP() << "built without the benchmarks, which bring Embree";
}

#endif

} // namespace
} // namespace macula::bvh::test
