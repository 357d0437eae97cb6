#include "scenes/validate.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/defaults.hpp"
#include "scenes/validate_mesh.hpp"
#include "scenes/validate_motion.hpp"

namespace macula::scene {
namespace {

bool finite(float x) {
    return std::isfinite(x) && std::fabs(x) < kMaxCoordinate;
}
bool finite(const glm::vec3& p) {
    return finite(p.x) && finite(p.y) && finite(p.z);
}

// Replaces a value that is not a number in [lo, hi]; says whether it did.
bool bound(float& value, float lo, float hi, float fallback) {
    const float before = value;
    value = std::isnan(value) ? fallback : std::clamp(value, lo, hi);
    return value != before; // also for NaN
}

bool bound(glm::vec3& colour, float hi) {
    bool changed = false;
    for (int c = 0; c < 3; ++c)
        changed = bound(colour[c], 0.0f, hi, 0.0f) || changed;
    return changed;
}

constexpr float kMaxRadiance = 1e9f;

void check_texture_index(std::uint32_t index, const Scene& scene, const Material& material) {
    if (index != kNoTexture && index >= scene.textures.size())
        throw SceneError(scene.name + ": material '" + material.name + "': texture index " +
                         std::to_string(index) + " is out of range");
}

void validate_materials(Scene& scene) {
    if (scene.materials.empty()) {
        scene.materials.emplace_back();
        scene.materials.back().name = "default";
    }
    for (Material& m : scene.materials) {
        for (const std::uint32_t index : {m.diffuse_texture, m.alpha_texture, m.specular_texture,
                                          m.normal_texture, m.emission_texture})
            check_texture_index(index, scene, m);
        bool changed = bound(m.diffuse, 1.0f);
        changed = bound(m.specular, 1.0f) || changed;
        changed = bound(m.reflectivity, 1.0f) || changed;
        changed = bound(m.transmission, 1.0f) || changed;
        changed = bound(m.emission, kMaxRadiance) || changed;
        changed = bound(m.shininess, 1.0f, 1e5f, 32.0f) || changed;
        changed = bound(m.opacity, 0.0f, 1.0f, 1.0f) || changed;
        changed = bound(m.alpha_cutoff, 0.0f, 1.0f, 0.5f) || changed;
        changed = bound(m.index_of_refraction, 0.1f, 10.0f, 1.0f) || changed;
        if (changed)
            scene.warnings.push_back("material '" + m.name + "': values out of range are clamped");
    }
}

void validate_textures(const Scene& scene) {
    for (const Texture& texture : scene.textures) {
        bool good = !texture.levels.empty() && texture.levels.back().width == 1 &&
                    texture.levels.back().height == 1;
        for (std::size_t i = 0; good && i < texture.levels.size(); ++i) {
            const MipLevel& level = texture.levels[i];
            good = level.width > 0 && level.height > 0 &&
                   level.rgba.size() == std::size_t{level.width} * level.height * 4;
            if (good && i > 0)
                good = level.width == std::max(1u, texture.levels[i - 1].width / 2) &&
                       level.height == std::max(1u, texture.levels[i - 1].height / 2);
        }
        if (!good)
            throw SceneError(scene.name + ": texture '" + texture.name +
                             "': its mip chain is not complete");
    }
}

float determinant(const Transform& t) {
    return glm::dot(glm::vec3(t.row[0]), glm::cross(glm::vec3(t.row[1]), glm::vec3(t.row[2])));
}

void validate_instances(Scene& scene) {
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const std::string where =
            scene.name + ": instance " + std::to_string(i) + " '" + instance.name + "'";
        if (instance.mesh >= scene.meshes.size())
            throw SceneError(where + ": mesh index " + std::to_string(instance.mesh) +
                             " is out of range");
        for (const glm::vec4& row : instance.world_from_object.row)
            for (int c = 0; c < 4; ++c)
                if (!finite(row[c]))
                    throw SceneError(where + ": the transform is not finite");
        const float det = determinant(instance.world_from_object);
        if (!std::isnormal(det))
            throw SceneError(where + ": the transform is singular");
    }
}

void drop_empty_meshes(Scene& scene) {
    std::vector<std::uint32_t> renumbered(scene.meshes.size(), kNoTexture);
    std::vector<Mesh> kept;
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        if (scene.meshes[i].triangles.empty())
            continue;
        renumbered[i] = static_cast<std::uint32_t>(kept.size());
        kept.push_back(std::move(scene.meshes[i]));
    }
    const std::size_t dropped = scene.meshes.size() - kept.size();
    scene.meshes = std::move(kept);
    if (dropped == 0)
        return;
    std::vector<std::uint32_t> instances(scene.instances.size(), kNoTexture);
    std::vector<Instance> placed;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        if (renumbered[scene.instances[i].mesh] == kNoTexture)
            continue;
        instances[i] = static_cast<std::uint32_t>(placed.size());
        placed.push_back(std::move(scene.instances[i]));
        placed.back().mesh = renumbered[placed.back().mesh];
    }
    scene.instances = std::move(placed);
    renumber_moving(scene, instances);
    scene.warnings.push_back(std::to_string(dropped) + " meshes without triangles are left out");
}

void validate_lights(Scene& scene) {
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        Light& light = scene.lights[i];
        const std::string where = scene.name + ": light " + std::to_string(i);
        if (!finite(light.position) || !finite(light.direction) || !finite(light.edge_u) ||
            !finite(light.edge_v))
            throw SceneError(where + ": position or direction is not finite");
        bool changed = bound(light.colour, kMaxRadiance);
        changed = bound(light.radius, 0.0f, kMaxCoordinate, 0.0f) || changed;
        changed = bound(light.attenuation_distance, 0.0f, kMaxCoordinate, 0.0f) || changed;
        changed = bound(light.angle, 0.0f, 80.0f, 0.0f) || changed;
        if (changed)
            scene.warnings.push_back(where + ": values out of range are clamped");
        const float length = glm::length(light.direction);
        if (light.kind == LightKind::directional && !(length > 1e-12f))
            throw SceneError(where + ": the direction has no length");
        if (length > 1e-12f)
            light.direction /= length;
        if (light.kind == LightKind::rectangle &&
            !(glm::length(glm::cross(light.edge_u, light.edge_v)) > 0.0f))
            throw SceneError(where + ": the rectangle has no area");
    }
}

void validate_cameras(Scene& scene) {
    for (Camera& camera : scene.cameras) {
        const std::string where = scene.name + ": camera '" + camera.name + "'";
        if (!finite(camera.eye) || !finite(camera.target) || !finite(camera.up))
            throw SceneError(where + ": eye, target or up is not finite");
        if (camera.eye == camera.target)
            throw SceneError(where + ": eye and target are the same point");
        if (!(camera.vertical_fov_degrees >= 1.0f && camera.vertical_fov_degrees <= 170.0f))
            throw SceneError(where + ": the field of view must lie between 1 and 170 degrees");
        const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
        const float up_length = glm::length(camera.up);
        if (!(up_length > 1e-12f) ||
            glm::length(glm::cross(forward, camera.up / up_length)) < 1e-4f)
            camera.up = std::fabs(forward.y) > 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    }
    for (std::size_t i = 0; i < scene.path.keys.size(); ++i) {
        const CameraKey& key = scene.path.keys[i];
        const std::string where = scene.name + ": key " + std::to_string(i) + " of the camera path";
        if (!std::isfinite(key.frame) || !finite(key.eye) || !finite(key.target))
            throw SceneError(where + " is not finite");
        if (key.eye == key.target)
            throw SceneError(where + ": eye and target are the same point");
        if (i > 0 && !(key.frame > scene.path.keys[i - 1].frame))
            throw SceneError(where + ": its frame is not after the one before");
    }
}

} // namespace

void validate(Scene& scene) {
    std::uint64_t triangles = 0;
    for (const Mesh& mesh : scene.meshes)
        triangles += mesh.triangles.size();
    if (triangles > kMaxTriangles)
        throw SceneError(scene.name + ": " + std::to_string(triangles) +
                         " triangles are more than the limit of " + std::to_string(kMaxTriangles));
    validate_materials(scene);
    validate_textures(scene);
    validate_instances(scene);
    validate_meshes(scene);
    validate_motion(scene);
    drop_empty_meshes(scene);
    if (scene.instances.empty())
        throw SceneError(scene.name + ": the scene has no triangles");
    const Bounds box = scene.bounds();
    if (!finite(box.lo) || !finite(box.hi))
        throw SceneError(scene.name + ": an instance lies beyond the largest coordinate, 1e18");
    bound(scene.ambient, kMaxRadiance);
    bound(scene.background, kMaxRadiance);
    bound(scene.ambient_occlusion_radius, 0.0f, kMaxCoordinate, 0.0f);
    validate_lights(scene);
    validate_cameras(scene);
    add_default_view(scene);
}

} // namespace macula::scene
