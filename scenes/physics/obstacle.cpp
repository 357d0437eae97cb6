#include "scenes/physics/obstacle.hpp"

#include <algorithm>
#include <numeric>
#include <string>

#include "scenes/error.hpp"

namespace macula::scene::physics {
namespace {

constexpr std::size_t kMostTriangles = std::size_t{1} << (31 - MAX_NUM_PARTS_IN_BITS);

std::vector<Triangle> triangles_of(const Scene& scene, std::uint32_t index, const Units& units) {
    const Instance& instance = scene.instances[index];
    const Mesh& mesh = scene.meshes[instance.mesh];
    const std::size_t count = mesh.triangles.size();
    if (count == 0 || count > kMostTriangles)
        throw SceneError(scene.name + ": physics: the obstacle '" + instance.name + "' has " +
                         std::to_string(count) + " triangles, not 1 to " +
                         std::to_string(kMostTriangles));
    const auto corner = [&](std::uint32_t vertex) {
        return units.from_world(instance.world_from_object.apply(mesh.positions[vertex]));
    };
    std::vector<Triangle> triangles;
    triangles.reserve(count);
    for (const glm::uvec3& t : mesh.triangles)
        triangles.push_back({corner(t.x), corner(t.y), corner(t.z)});
    return triangles;
}

std::unique_ptr<btTriangleIndexVertexArray> arrays_of(std::vector<Triangle>& triangles,
                                                      std::vector<int>& indices) {
    indices.resize(3 * triangles.size());
    std::iota(indices.begin(), indices.end(), 0);
    btIndexedMesh part;
    part.m_numTriangles = static_cast<int>(triangles.size());
    part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(indices.data());
    part.m_triangleIndexStride = 3 * sizeof(int);
    part.m_numVertices = static_cast<int>(indices.size());
    part.m_vertexBase = reinterpret_cast<const unsigned char*>(triangles.data());
    part.m_vertexStride = sizeof(glm::vec3);
    part.m_vertexType = PHY_FLOAT;
    auto arrays = std::make_unique<btTriangleIndexVertexArray>();
    arrays->addIndexedMesh(part, PHY_INTEGER);
    return arrays;
}

} // namespace

Obstacle::Obstacle(const Scene& scene, std::uint32_t instance, const Units& units)
    : triangles_(triangles_of(scene, instance, units)), arrays_(arrays_of(triangles_, indices_)),
      shape_(std::make_unique<btBvhTriangleMeshShape>(arrays_.get(), true)),
      tree_(std::make_unique<BoxTree>(*shape_->getOptimizedBvh())) {
    shape_->setUserPointer(this);
}

int Obstacle::last_level(int left_out) const {
    return std::max(coarsest_level_, tree_->height() - left_out);
}

} // namespace macula::scene::physics
