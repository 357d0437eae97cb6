#include "scenes/scene.hpp"

#include <algorithm>
#include <limits>

namespace macula::scene {

bool Transform::is_identity() const {
    return *this == Transform{};
}

glm::vec3 Transform::apply(const glm::vec3& p) const {
    const glm::vec4 h(p, 1.0f);
    return {glm::dot(row[0], h), glm::dot(row[1], h), glm::dot(row[2], h)};
}

std::uint64_t Scene::triangle_count() const {
    std::uint64_t count = 0;
    for (const Instance& instance : instances)
        count += meshes[instance.mesh].triangles.size();
    return count;
}

Bounds Scene::bounds() const {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    Bounds box{glm::vec3(kInfinity), glm::vec3(-kInfinity)};
    for (const Instance& instance : instances) {
        const Mesh& mesh = meshes[instance.mesh];
        const bool identity = instance.world_from_object.is_identity();
        for (const glm::uvec3& triangle : mesh.triangles) {
            for (int corner = 0; corner < 3; ++corner) {
                const glm::vec3& object = mesh.positions[triangle[corner]];
                const glm::vec3 p = identity ? object : instance.world_from_object.apply(object);
                box.lo = glm::min(box.lo, p);
                box.hi = glm::max(box.hi, p);
            }
        }
    }
    return box.lo.x <= box.hi.x ? box : Bounds{};
}

} // namespace macula::scene
