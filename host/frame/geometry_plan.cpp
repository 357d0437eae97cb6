#include "host/frame/geometry_plan.hpp"

#include <stdexcept>
#include <string>

#include "scenes/mover.hpp"

namespace macula::frame {
namespace {

// A stored triangle id has 31 bits, and MACULA_NO_TRIANGLE is no id.
constexpr std::uint64_t kMostTriangles = 0x7fffffffu;
constexpr std::uint64_t kMostVertices = 0xffffffffu;

class Planner {
  public:
    Planner(const scene::Scene& scene, const std::vector<std::uint8_t>& is_masked)
        : scene_(scene), is_masked_(is_masked) {}

    GeometryPlan run(bool merge_static) {
        check_instances();
        count_uses();
        plan_.device_instance.resize(scene_.instances.size());
        if (merge_static)
            merge();
        std::vector<std::uint32_t> planned(scene_.meshes.size(), kMerged);
        for (std::uint32_t i = 0; i < scene_.instances.size(); ++i) {
            if (merge_static && is_static(i))
                continue;
            const std::uint32_t mesh = scene_.instances[i].mesh;
            if (planned[mesh] == kMerged) {
                planned[mesh] = start_mesh();
                append(mesh, i);
            }
            plan_.device_instance[i] = add_instance(planned[mesh], i);
        }
        return std::move(plan_);
    }

  private:
    std::string name_of(std::uint32_t mesh) const {
        return "mesh " + std::to_string(mesh) + " (\"" + scene_.meshes[mesh].name + "\")";
    }

    void check_instances() const {
        std::uint64_t ids = 0;
        for (std::size_t i = 0; i < scene_.instances.size(); ++i) {
            const std::uint32_t mesh = scene_.instances[i].mesh;
            if (mesh >= scene_.meshes.size())
                throw std::invalid_argument("scene geometry: instance " + std::to_string(i) +
                                            " names mesh " + std::to_string(mesh) + " of " +
                                            std::to_string(scene_.meshes.size()));
            ids += scene_.meshes[mesh].triangles.size();
            if (ids > kMostTriangles)
                throw std::invalid_argument("scene geometry: more than 2^31 - 1 triangles over "
                                            "all instances");
        }
        if (ids == 0)
            throw std::invalid_argument("scene geometry: the scene has no triangles");
    }

    void count_uses() {
        uses_.assign(scene_.meshes.size(), 0);
        for (const scene::Instance& instance : scene_.instances)
            ++uses_[instance.mesh];
        moves_.assign(scene_.instances.size(), 0);
        for (const std::uint32_t instance : scene::moving_instances(scene_))
            moves_.at(instance) = 1;
    }

    bool is_static(std::uint32_t instance) const {
        return moves_[instance] == 0 && uses_[scene_.instances[instance].mesh] == 1 &&
               scene_.instances[instance].world_from_object.is_identity();
    }

    void merge() {
        std::uint32_t mesh = kMerged, device_instance = 0;
        for (std::uint32_t i = 0; i < scene_.instances.size(); ++i) {
            if (!is_static(i))
                continue;
            if (mesh == kMerged)
                mesh = start_mesh();
            append(scene_.instances[i].mesh, i);
            plan_.device_instance[i] = device_instance;
        }
        if (mesh != kMerged)
            add_instance(mesh, kMerged);
    }

    std::uint32_t start_mesh() {
        plan_.meshes.emplace_back().first_entry = static_cast<std::uint32_t>(entries_);
        return static_cast<std::uint32_t>(plan_.meshes.size() - 1);
    }

    // Appends scene mesh `mesh` to the last device mesh.
    void append(std::uint32_t mesh, std::uint32_t instance) {
        const scene::Mesh& from = scene_.meshes[mesh];
        PlannedMesh& to = plan_.meshes.back();
        const std::uint64_t first = to.positions.size() / 3;
        if (first + from.positions.size() > kMostVertices)
            throw std::invalid_argument("scene geometry: more than 2^32 - 1 vertices in one mesh");
        if (from.triangle_material.size() != from.triangles.size())
            throw std::invalid_argument("scene geometry: " + name_of(mesh) +
                                        " has not one material for each triangle");
        if (!from.uvs.empty() && from.uvs.size() != from.positions.size())
            throw std::invalid_argument("scene geometry: " + name_of(mesh) +
                                        " has texture coordinates for some vertices only");
        plan_.parts.push_back({mesh, instance, static_cast<std::uint32_t>(entries_),
                               static_cast<std::uint32_t>(from.triangles.size())});
        entries_ += from.triangles.size();
        for (const glm::vec3& p : from.positions)
            to.positions.insert(to.positions.end(), {p.x, p.y, p.z});
        for (std::size_t i = 0; i < from.triangles.size(); ++i)
            append_triangle(mesh, i, static_cast<std::uint32_t>(first), to);
    }

    void append_triangle(std::uint32_t mesh, std::size_t index, std::uint32_t first_vertex,
                         PlannedMesh& to) {
        const scene::Mesh& from = scene_.meshes[mesh];
        const glm::uvec3 t = from.triangles[index];
        const std::uint32_t material = from.triangle_material[index];
        // Checked here, since an index beyond its mesh would be inside the merged one.
        if (t.x >= from.positions.size() || t.y >= from.positions.size() ||
            t.z >= from.positions.size())
            throw std::invalid_argument("scene geometry: " + name_of(mesh) + ", triangle " +
                                        std::to_string(index) + ": a vertex index is not below " +
                                        std::to_string(from.positions.size()));
        if (material >= is_masked_.size())
            throw std::invalid_argument("scene geometry: " + name_of(mesh) + ", triangle " +
                                        std::to_string(index) + ": material " +
                                        std::to_string(material) + " of " +
                                        std::to_string(is_masked_.size()));
        to.triangles.push_back({first_vertex + t.x, first_vertex + t.y, first_vertex + t.z});
        to.masked.push_back(is_masked_[material]);
        plan_.materials.push_back(material);
    }

    std::uint32_t add_instance(std::uint32_t mesh, std::uint32_t scene_instance) {
        shared::Instance instance{};
        const scene::Transform transform = scene_instance == kMerged
                                               ? scene::Transform{}
                                               : scene_.instances[scene_instance].world_from_object;
        set_rows(instance.world_from_object, transform);
        set_rows(instance.previous_world_from_object, transform);
        instance.first_triangle = static_cast<std::uint32_t>(plan_.triangle_ids);
        instance.mesh = mesh;
        instance.mesh_triangle = plan_.meshes[mesh].first_entry;
        instance.triangle_count = static_cast<std::uint32_t>(plan_.meshes[mesh].triangles.size());
        plan_.triangle_ids += instance.triangle_count;
        plan_.instances.push_back(instance);
        plan_.scene_instance.push_back(scene_instance);
        return static_cast<std::uint32_t>(plan_.instances.size() - 1);
    }

    const scene::Scene& scene_;
    const std::vector<std::uint8_t>& is_masked_;
    std::vector<std::uint32_t> uses_; // of each mesh
    std::vector<std::uint8_t> moves_; // by instance
    std::uint64_t entries_ = 0;
    GeometryPlan plan_;
};

} // namespace

GeometryPlan plan_geometry(const scene::Scene& scene, const std::vector<std::uint8_t>& is_masked,
                           bool merge_static) {
    return Planner(scene, is_masked).run(merge_static);
}

void set_rows(float (&rows)[3][4], const scene::Transform& transform) {
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column)
            rows[row][column] = transform.row[row][column];
    }
}

} // namespace macula::frame
