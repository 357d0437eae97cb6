// Area lights from what the file itself says glows.
#include <algorithm>
#include <map>
#include <numbers>

#include "scenes/defaults.hpp"

namespace macula::scene {
namespace {

struct Corners {
    glm::vec3 p[3];
};

// The two triangles of one parallelogram as a rectangle light, or nothing.
bool to_rectangle(const Corners& first, const Corners& second, Light& light) {
    // The corner of `second` that `first` does not have lies opposite to one of first's corners.
    std::vector<int> unshared_first, unshared_second;
    for (int i = 0; i < 3; ++i) {
        const auto equals = [](const glm::vec3& a) {
            return [a](const glm::vec3& b) { return a == b; };
        };
        if (std::none_of(second.p, second.p + 3, equals(first.p[i])))
            unshared_first.push_back(i);
        if (std::none_of(first.p, first.p + 3, equals(second.p[i])))
            unshared_second.push_back(i);
    }
    if (unshared_first.size() != 1 || unshared_second.size() != 1)
        return false;
    const int at = unshared_first[0];
    const glm::vec3 origin = first.p[at];
    light.edge_u = first.p[(at + 1) % 3] - origin;
    light.edge_v = first.p[(at + 2) % 3] - origin;
    const glm::vec3 opposite = second.p[unshared_second[0]];
    const glm::vec3 corner = origin + light.edge_u + light.edge_v;
    const float size = glm::length(light.edge_u) + glm::length(light.edge_v);
    if (glm::distance(corner, opposite) > 0.02f * size ||
        !(glm::length(glm::cross(light.edge_u, light.edge_v)) > 0.0f))
        return false;
    light.position = origin + 0.5f * (light.edge_u + light.edge_v);
    return true;
}

} // namespace

std::vector<Light> lights_of_emissive_quads(const Scene& scene) {
    std::map<std::uint32_t, std::vector<Corners>> triangles;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const std::uint32_t material = mesh.triangle_material[t];
            const glm::vec3& glow = scene.materials[material].emission;
            if (std::max({glow.r, glow.g, glow.b}) <= 0.0f)
                continue;
            std::vector<Corners>& list = triangles[material];
            if (list.size() > 2)
                continue;
            Corners corners;
            for (int i = 0; i < 3; ++i)
                corners.p[i] =
                    instance.world_from_object.apply(mesh.positions[mesh.triangles[t][i]]);
            list.push_back(corners);
        }
    }
    std::vector<Light> lights;
    for (const auto& [material, list] : triangles) {
        Light light;
        light.kind = LightKind::rectangle;
        if (list.size() != 2 || !to_rectangle(list[0], list[1], light))
            continue;
        // Radiance times area is the intensity; a white Lambertian surface reflects 1 / pi of it.
        const float area = glm::length(glm::cross(light.edge_u, light.edge_v));
        light.colour = scene.materials[material].emission * (area / std::numbers::pi_v<float>);
        light.attenuation_distance = 1.0f;
        lights.push_back(light);
    }
    std::stable_sort(lights.begin(), lights.end(), [](const Light& a, const Light& b) {
        return a.colour.r + a.colour.g + a.colour.b > b.colour.r + b.colour.g + b.colour.b;
    });
    if (lights.size() > kMaxEmissiveLights)
        lights.resize(kMaxEmissiveLights);
    return lights;
}

} // namespace macula::scene
