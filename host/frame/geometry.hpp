// The scene's geometry on a device: one SBVH a mesh, concatenated in whatever layouts the chosen
// traversal variants ask for, the instances, the upper level and the alpha masks.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bvh/bvh.hpp"
#include "bvh/reference.hpp"
#include "host/cl/device.hpp"
#include "scenes/scene.hpp"

namespace macula::frame {

struct GeometryOptions {
    bvh::BuildOptions build;
    std::filesystem::path cache_directory; // of bvh::build_cached; empty: no cache
    bool merge_static = true; // meshes placed once, unmoved, become one mesh with one instance
};

// Where the triangles of a device mesh came from. Parts lie in the order of the per-mesh triangle
// tables: triangle k of scene mesh `mesh` has the table index first_entry + k. A material table,
// or one of vertex attributes, is filled by walking the parts.
struct MeshPart {
    std::uint32_t mesh = 0;        // index into Scene::meshes
    std::uint32_t instance = 0;    // index into Scene::instances; of a shared mesh, the first one
    std::uint32_t first_entry = 0; // index into the per-mesh triangle tables
    std::uint32_t triangle_count = 0;
};

// What a scene-wide triangle id (HitBlock::triangle) stands for.
struct TriangleOrigin {
    std::uint32_t mesh = 0;            // index into Scene::meshes
    std::uint32_t triangle = 0;        // index into Mesh::triangles
    std::uint32_t instance = 0;        // index into Scene::instances
    std::uint32_t device_instance = 0; // index into the device's instance table
    std::uint32_t entry = 0;           // index into the per-mesh triangle tables
    std::uint32_t material = 0;        // index into Scene::materials
};

struct LayoutStatistics {
    bvh::Layout layout = bvh::Layout::binary;
    std::uint64_t node_bytes = 0, triangle_bytes = 0;
};

struct GeometryStatistics {
    std::uint32_t meshes = 0;         // on the device, after merging
    std::uint32_t instances = 0;      // on the device, after merging
    std::uint64_t mesh_triangles = 0; // over meshes
    std::uint64_t triangles = 0;      // over instances: the number of triangle ids
    std::uint32_t masked_triangles = 0;
    double sah = 0.0;               // of the meshes' trees, weighted by triangles
    double duplication = 1.0;       // references / triangles
    std::uint32_t depth = 0;        // of the deepest lower level
    double build_seconds = 0.0;     // wall clock of building or loading all trees
    bool from_cache = false;        // all of them
    std::vector<std::string> notes; // why a cache file was not used
};

// Buffers of one layout, for the arguments of kernels/lib/trace_contract.h.
struct LayoutBuffers {
    compute::Buffer nodes;
    compute::Buffer triangles;
    compute::Buffer instances; // with this layout's roots
};

struct MaskBuffers {
    compute::Buffer slots;     // uint a per-mesh triangle
    compute::Buffer triangles; // shared::MaskTriangle
    compute::Buffer textures;  // shared::MaskTexture
    compute::Buffer words;     // bits
};

class DeviceGeometry {
  public:
    // Builds (or loads) the trees; uploads masks and the upper level. The scene may be destroyed
    // afterwards. Throws std::invalid_argument for a scene without triangles, with more than 2^31
    // triangles, with an index out of range or with a singular transform, and the device's own
    // error when a buffer does not fit.
    DeviceGeometry(compute::Device& device, const scene::Scene& scene,
                   const GeometryOptions& options = {});
    ~DeviceGeometry();
    DeviceGeometry(const DeviceGeometry&) = delete;
    DeviceGeometry& operator=(const DeviceGeometry&) = delete;

    // MACULA_INSTANCES: false when the scene is one instance with the identity transform.
    bool instanced() const;
    // MACULA_MASKS.
    bool masked() const;

    // Laid out and uploaded at the first request; the references stay valid until destruction.
    const LayoutBuffers& layout(bvh::Layout layout);
    const compute::Buffer& upper_nodes() const;
    const MaskBuffers& masks() const;

    // Next frame's transforms, one a scene instance: keeps the present ones as the previous ones,
    // rebuilds the upper level and uploads both. Throws std::invalid_argument for a wrong number,
    // a singular transform, or when it moves an instance that was merged.
    void set_transforms(std::span<const scene::Transform> world_from_object);

    // The instances on the host; `root` is 0, since it depends on the layout.
    std::span<const shared::Instance> instances() const;
    std::span<const MeshPart> parts() const;
    // Throws std::out_of_range beyond the last id.
    TriangleOrigin origin_of(std::uint32_t triangle_id) const;

    // The same scene for the CPU oracle; its spans live as long as this object, and as long as no
    // set_transforms is called.
    bvh::ReferenceScene reference();
    // Gathered at the first call.
    const GeometryStatistics& statistics();
    std::vector<LayoutStatistics> layout_statistics() const; // of the layouts on the device

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace macula::frame
