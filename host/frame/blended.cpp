#include "host/frame/blended.hpp"

#include <algorithm>
#include <vector>

namespace macula::frame {
namespace {

bool any_positive(const glm::vec3& v) {
    return v.x > 0.0f || v.y > 0.0f || v.z > 0.0f;
}

std::vector<bool> blended_materials(const scene::Scene& scene) {
    std::vector<bool> blended;
    for (const scene::Material& material : scene.materials)
        blended.push_back(is_blended(material));
    return blended;
}

bool is_wanted(const scene::Mesh& mesh, std::size_t triangle, const std::vector<bool>& blended,
               bool wanted) {
    const std::uint32_t material = mesh.triangle_material[triangle];
    return material < blended.size() && blended[material] == wanted;
}

// The mesh with the wanted triangles and the vertices that they use, in their order.
scene::Mesh part_of(const scene::Mesh& mesh, const std::vector<bool>& blended, bool wanted) {
    constexpr std::uint32_t kUnused = 0xffffffffu;
    scene::Mesh part;
    part.name = mesh.name;
    std::vector<std::uint32_t> place(mesh.positions.size(), kUnused);
    const auto placed = [&](std::uint32_t vertex) {
        if (vertex >= place.size() || place[vertex] != kUnused)
            return vertex < place.size() ? place[vertex] : vertex;
        place[vertex] = static_cast<std::uint32_t>(part.positions.size());
        part.positions.push_back(mesh.positions[vertex]);
        if (!mesh.normals.empty())
            part.normals.push_back(mesh.normals[vertex]);
        if (!mesh.uvs.empty())
            part.uvs.push_back(mesh.uvs[vertex]);
        return place[vertex];
    };
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (!is_wanted(mesh, i, blended, wanted))
            continue;
        const glm::uvec3& t = mesh.triangles[i];
        const std::uint32_t a = placed(t.x), b = placed(t.y), c = placed(t.z);
        part.triangles.emplace_back(a, b, c);
        part.triangle_material.push_back(mesh.triangle_material[i]);
    }
    return part;
}

scene::Scene part_of(const scene::Scene& scene, const std::vector<bool>& blended, bool wanted) {
    scene::Scene part;
    part.instances = scene.instances;
    part.motion = scene.motion;
    part.physics = scene.physics;
    part.materials = scene.materials;
    if (wanted) // their alpha is no mask
        for (scene::Material& material : part.materials)
            material.alpha_mode = scene::AlphaMode::opaque;
    else // the textures go to the device once
        part.textures = scene.textures;
    for (const scene::Mesh& mesh : scene.meshes)
        part.meshes.push_back(part_of(mesh, blended, wanted));
    return part;
}

void keep_one_triangle(scene::Scene& part) {
    scene::Mesh& mesh = part.meshes[part.instances.front().mesh];
    mesh.positions.resize(1);
    mesh.normals.clear();
    mesh.uvs.clear();
    mesh.triangles = {glm::uvec3(0)};
    mesh.triangle_material = {0};
}

GeometryOptions without_splits(GeometryOptions options) {
    options.build.spatial_splits = false;
    return options;
}

} // namespace

bool is_blended(const scene::Material& m) {
    const bool textured =
        m.alpha_texture != scene::kNoTexture || m.diffuse_texture != scene::kNoTexture;
    return m.alpha_mode == scene::AlphaMode::blend && !any_positive(m.transmission) &&
           (m.opacity < 1.0f || textured);
}

std::optional<SplitScene> split_blended(const scene::Scene& scene) {
    const std::vector<bool> blended = blended_materials(scene);
    const bool any = std::ranges::any_of(scene.instances, [&](const scene::Instance& instance) {
        if (instance.mesh >= scene.meshes.size())
            return false; // DeviceGeometry says so
        const scene::Mesh& mesh = scene.meshes[instance.mesh];
        for (std::size_t i = 0; i < mesh.triangle_material.size(); ++i)
            if (is_wanted(mesh, i, blended, true))
                return true;
        return false;
    });
    if (!any)
        return std::nullopt;
    SplitScene split{part_of(scene, blended, false), part_of(scene, blended, true)};
    if (split.opaque.triangle_count() == 0)
        keep_one_triangle(split.opaque);
    return split;
}

DeviceBlended::DeviceBlended(compute::Device& device, const scene::Scene& scene,
                             const DeviceSurfaces& opaque, const GeometryOptions& options)
    : geometry(device, scene, without_splits(options)),
      surfaces(device, scene, geometry.parts(), &opaque) {}

} // namespace macula::frame
