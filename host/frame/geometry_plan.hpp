// Which meshes and instances go to the device: the scene's, with the unmoved ones merged.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bvh/bvh.hpp"
#include "host/frame/geometry.hpp"
#include "scenes/scene.hpp"

namespace macula::frame {

// One mesh of the device in object space.
struct PlannedMesh {
    std::vector<float> positions; // xyz
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint8_t> masked; // one a triangle
    std::uint32_t first_entry = 0;    // of its triangles, in the per-mesh triangle tables

    bvh::Geometry geometry() const { return {positions, triangles, masked}; }
};

inline constexpr std::uint32_t kMerged = 0xffffffffu;

struct GeometryPlan {
    std::vector<PlannedMesh> meshes;
    std::vector<MeshPart> parts; // in the order of first_entry
    // Matrices, ids and table indices are set; boxes and roots are not.
    std::vector<shared::Instance> instances;
    std::vector<std::uint32_t> scene_instance;  // of each device instance; kMerged: of several
    std::vector<std::uint32_t> device_instance; // of each scene instance
    std::vector<std::uint32_t> materials;       // by entry of the per-mesh triangle tables
    std::uint64_t triangle_ids = 0;             // over instances
};

// `is_masked[m]` is non-zero where material m has an alpha mask. Throws std::invalid_argument for
// the scenes that DeviceGeometry refuses.
GeometryPlan plan_geometry(const scene::Scene& scene, const std::vector<std::uint8_t>& is_masked,
                           bool merge_static);

void set_rows(float (&rows)[3][4], const scene::Transform& transform);

} // namespace macula::frame
