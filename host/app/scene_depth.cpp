#include "host/app/scene_depth.hpp"

#include <array>
#include <limits>
#include <vector>

#include "bvh/reference.hpp"

namespace macula::app {
namespace {

struct Triangles {
    std::vector<float> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

// All instances in world space.
Triangles gather(const scene::Scene& scene) {
    Triangles all;
    for (const scene::Instance& instance : scene.instances) {
        const scene::Mesh& mesh = scene.meshes[instance.mesh];
        const auto first = static_cast<std::uint32_t>(all.positions.size() / 3);
        for (const glm::vec3& p : mesh.positions) {
            const glm::vec3 world = instance.world_from_object.apply(p);
            all.positions.insert(all.positions.end(), {world.x, world.y, world.z});
        }
        for (const glm::uvec3& t : mesh.triangles)
            all.triangles.push_back({first + t.x, first + t.y, first + t.z});
    }
    return all;
}

} // namespace

struct SceneDepth::State {
    bvh::LaidOut mesh;
    shared::Instance instance{};
    std::vector<shared::BinaryNode> upper;

    explicit State(const scene::Scene& scene) {
        const Triangles all = gather(scene);
        const bvh::Geometry geometry{all.positions, all.triangles, {}};
        bvh::BuildOptions options;
        options.spatial_splits = false; // a few rays a frame
        mesh = bvh::lay_out(bvh::build(geometry, options), geometry, bvh::Layout::binary);
        for (int row = 0; row < 3; ++row)
            instance.world_from_object[row][row] = 1.0f;
        instance.root = mesh.root;
        instance.triangle_count = static_cast<std::uint32_t>(all.triangles.size());
        bvh::place(instance, mesh.box);
        upper = bvh::build_upper({&instance, 1});
    }

    bvh::ReferenceScene scene() const {
        return {{reinterpret_cast<const shared::BinaryNode*>(mesh.nodes.data()), mesh.node_count},
                {reinterpret_cast<const shared::Triangle*>(mesh.triangles.data()),
                 mesh.triangle_entries},
                {&instance, 1},
                upper,
                {}};
    }
};

SceneDepth::SceneDepth(const scene::Scene& scene) : state_(std::make_unique<State>(scene)) {}
SceneDepth::~SceneDepth() = default;

double SceneDepth::along(const glm::vec3& origin, const glm::vec3& direction) const {
    constexpr float kFar = 1e30f;
    const glm::vec3 unit = glm::normalize(direction);
    const bvh::Ray ray{{origin.x, origin.y, origin.z}, {unit.x, unit.y, unit.z}, 0.0f, kFar};
    const shared::TraceHit hit = bvh::closest(ray, state_->scene());
    return hit.triangle == MACULA_NO_TRIANGLE ? std::numeric_limits<double>::infinity() : hit.t;
}

} // namespace macula::app
