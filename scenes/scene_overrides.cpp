#include "scenes/scene_overrides.hpp"

#include <array>
#include <set>

#include "scenes/mover.hpp"

namespace macula::scene {
namespace {

// A cyclic exchange of axes is a rotation: it keeps the scene right-handed.
glm::vec3 turned(const glm::vec3& p, UpAxis up) {
    if (up == UpAxis::z)
        return {p.y, p.z, p.x};
    return up == UpAxis::x ? glm::vec3(p.z, p.x, p.y) : p;
}

Transform turned(const Transform& t, UpAxis up, float scale) {
    Transform result;
    const std::array<glm::vec4, 3> rows = {t.row[0], t.row[1], t.row[2]};
    const std::array<int, 3> source = up == UpAxis::z   ? std::array{1, 2, 0}
                                      : up == UpAxis::x ? std::array{2, 0, 1}
                                                        : std::array{0, 1, 2};
    for (std::size_t i = 0; i < 3; ++i)
        result.row[i] = rows[static_cast<std::size_t>(source[i])] * scale;
    return result;
}

glm::quat rotation_of(UpAxis up) {
    if (up == UpAxis::y)
        return {1.0f, 0.0f, 0.0f, 0.0f};
    const float side = up == UpAxis::z ? -0.5f : 0.5f;
    return {0.5f, side, side, side};
}

// What stands in the world is turned and scaled, and carries the rest with it.
void transform_motion(Motion& motion, UpAxis up, float scale) {
    const glm::quat rotation = rotation_of(up);
    for (MotionNode& node : motion.nodes) {
        if (node.parent != kNoNode)
            continue;
        node.rest.translation = turned(node.rest.translation, up) * scale;
        node.rest.rotation = rotation * node.rest.rotation;
        node.rest.scale *= scale;
        for (glm::vec3& value : node.translation.values)
            value = turned(value, up) * scale;
        for (glm::quat& value : node.rotation.values)
            value = rotation * value;
        for (glm::vec3& value : node.scale.values)
            value *= scale;
    }
}

// Spheres stay rigid: what grows is their meshes, not their transforms.
void transform_physics(Scene& scene, UpAxis up, float scale) {
    Physics& physics = *scene.physics;
    std::set<std::uint32_t> meshes;
    for (const std::uint32_t sphere : physics.spheres) {
        if (sphere >= scene.instances.size())
            continue; // refused by validate()
        Instance& instance = scene.instances[sphere];
        if (instance.world_from_object.is_identity() || instance.mesh >= scene.meshes.size())
            continue;
        meshes.insert(instance.mesh);
        for (glm::vec4& row : instance.world_from_object.row)
            row = glm::vec4(glm::vec3(row) / scale, row.w);
    }
    for (const std::uint32_t mesh : meshes)
        for (glm::vec3& p : scene.meshes[mesh].positions)
            p *= scale;
    physics.gravity = turned(physics.gravity, up) * scale;
    physics.radius *= scale;
    physics.speed *= scale;
    physics.reach *= scale;
}

template <typename T>
void assign(T& target, const std::optional<T>& value) {
    if (value)
        target = *value;
}

} // namespace

void transform_scene(Scene& scene, UpAxis up, float scale) {
    if (up == UpAxis::y && scale == 1.0f)
        return;
    std::vector<bool> in_place(scene.meshes.size(), true);
    for (const Instance& instance : scene.instances)
        if (!instance.world_from_object.is_identity() && instance.mesh < in_place.size())
            in_place[instance.mesh] = false;
    for (const std::uint32_t moving : moving_instances(scene))
        in_place[scene.instances[moving].mesh] = false;
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        if (!in_place[m])
            continue;
        for (glm::vec3& p : scene.meshes[m].positions)
            p = turned(p, up) * scale;
        for (glm::vec3& n : scene.meshes[m].normals)
            n = turned(n, up);
    }
    for (Instance& instance : scene.instances)
        if (instance.mesh < in_place.size() && !in_place[instance.mesh])
            instance.world_from_object = turned(instance.world_from_object, up, scale);
    transform_motion(scene.motion, up, scale);
    for (Light& light : scene.lights) {
        light.position = turned(light.position, up) * scale;
        light.direction = turned(light.direction, up);
        light.edge_u = turned(light.edge_u, up) * scale;
        light.edge_v = turned(light.edge_v, up) * scale;
        light.radius *= scale;
        light.attenuation_distance *= scale;
    }
    for (Camera& camera : scene.cameras) {
        camera.eye = turned(camera.eye, up) * scale;
        camera.target = turned(camera.target, up) * scale;
        camera.up = turned(camera.up, up);
    }
    for (CameraKey& key : scene.path.keys) {
        key.eye = turned(key.eye, up) * scale;
        key.target = turned(key.target, up) * scale;
    }
    scene.ambient_occlusion_radius *= scale;
    if (scene.physics)
        transform_physics(scene, up, scale);
}

void override_material(const TomlTable& table, Scene& scene) {
    static constexpr KeyedValue<AlphaMode> kModes[] = {
        {"opaque", AlphaMode::opaque}, {"mask", AlphaMode::mask}, {"blend", AlphaMode::blend}};
    const std::string name = table.required_string("name");
    bool any = false;
    for (Material& material : scene.materials) {
        if (material.name != name)
            continue;
        any = true;
        assign(material.diffuse, table.colour("diffuse", 1.0));
        assign(material.specular, table.colour("specular", 1.0));
        assign(material.shininess, table.number("shininess", 1.0, 1e5));
        assign(material.emission, table.colour("emission", 1e9));
        assign(material.opacity, table.number("opacity", 0.0, 1.0));
        assign(material.index_of_refraction, table.number("index_of_refraction", 0.1, 10.0));
        assign(material.reflectivity, table.colour("reflectivity", 1.0));
        assign(material.transmission, table.colour("transmission", 1.0));
        assign(material.alpha_mode, table.choice<AlphaMode>("alpha_mode", kModes));
        assign(material.alpha_cutoff, table.number("alpha_cutoff", 0.0, 1.0));
        if (!table.boolean("textures").value_or(true))
            material.diffuse_texture = material.specular_texture = material.alpha_texture =
                material.normal_texture = material.emission_texture = kNoTexture;
    }
    if (!any)
        table.fail("name", "the scene has no material '" + name + "'");
    table.reject_unknown();
}

} // namespace macula::scene
