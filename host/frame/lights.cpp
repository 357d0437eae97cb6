#include "host/frame/lights.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "lib/sampling.h"

namespace macula::frame {
namespace {

using shared::float3;

void store(const glm::vec3& v, float (&out)[3]) {
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

void store_unit(float3 v, float (&out)[3]) {
    const float3 unit = unit3(v, {0.0f, -1.0f, 0.0f});
    out[0] = unit.x;
    out[1] = unit.y;
    out[2] = unit.z;
}

std::uint32_t kind_of(const scene::Light& light, LightMode mode) {
    const bool area = mode != LightMode::point;
    switch (light.kind) {
    case scene::LightKind::directional:
        return MACULA_LIGHT_DIRECTIONAL;
    case scene::LightKind::rectangle:
        return area ? MACULA_LIGHT_RECTANGLE : MACULA_LIGHT_COSINE_POINT;
    case scene::LightKind::point:
    case scene::LightKind::spherical:
        return area && light.radius > 0.0f ? MACULA_LIGHT_SPHERE : MACULA_LIGHT_POINT;
    }
    throw std::invalid_argument("unknown kind of light");
}

// 1 - cos of an angle in degrees, without cancellation.
float height_of_cone(float degrees) {
    float cosine = 1.0f;
    const float sine = shared::m_sin_cos_pi(degrees / 360.0f, &cosine);
    return 2.0f * (sine * sine);
}

shared::Light make_light(const scene::Light& light, LightMode mode, std::uint32_t samples) {
    shared::Light out{};
    out.kind = kind_of(light, mode);
    const bool soft = mode == LightMode::soft;
    const bool wide = soft && out.kind == MACULA_LIGHT_DIRECTIONAL && light.angle > 0.0f;
    const bool is_area =
        wide || out.kind == MACULA_LIGHT_SPHERE || out.kind == MACULA_LIGHT_RECTANGLE;
    store(light.position, out.position);
    store(light.colour, out.colour);
    out.samples = is_area ? samples : 1;
    out.columns = soft && is_area ? 0 : shared::strata_columns(out.samples);
    out.reference_distance_squared = light.attenuation_distance * light.attenuation_distance;
    const float3 u = {light.edge_u.x, light.edge_u.y, light.edge_u.z};
    const float3 v = {light.edge_v.x, light.edge_v.y, light.edge_v.z};
    if (light.kind == scene::LightKind::rectangle) {
        store(light.edge_u, out.edge_u);
        store(light.edge_v, out.edge_v);
        store_unit(cross3(u, v), out.direction);
    } else {
        const bool directional = light.kind == scene::LightKind::directional;
        const float angle = wide ? light.angle : 0.0f;
        out.radius = directional ? height_of_cone(angle) : light.radius;
        store_unit({light.direction.x, light.direction.y, light.direction.z}, out.direction);
    }
    return out;
}

} // namespace

const char* name(LightMode mode) {
    switch (mode) {
    case LightMode::point:
        return "point";
    case LightMode::area:
        return "area";
    case LightMode::soft:
        return "soft";
    case LightMode::ambient_occlusion:
        return "ao";
    }
    return "?";
}

std::optional<LightMode> parse_light_mode(std::string_view text) {
    for (const LightMode mode :
         {LightMode::point, LightMode::area, LightMode::soft, LightMode::ambient_occlusion})
        if (text == name(mode))
            return mode;
    return std::nullopt;
}

std::uint32_t default_light_samples(LightMode mode) {
    return mode == LightMode::soft ? 3 : 8;
}

std::vector<shared::Light> make_lights(const scene::Scene& scene, LightMode mode,
                                       std::uint32_t samples) {
    if (samples < 1 || samples > 4096)
        throw std::invalid_argument(
            fmt::format("samples of an area light must be 1 to 4096, not {}", samples));
    std::vector<shared::Light> lights;
    if (mode == LightMode::ambient_occlusion)
        return lights;
    for (const scene::Light& light : scene.lights)
        if (light.colour.x > 0.0f || light.colour.y > 0.0f || light.colour.z > 0.0f)
            lights.push_back(make_light(light, mode, samples));
    return lights;
}

float ambient_occlusion_radius(const scene::Scene& scene) {
    if (scene.ambient_occlusion_radius > 0.0f)
        return scene.ambient_occlusion_radius;
    return 0.15f * scene.bounds().diagonal();
}

} // namespace macula::frame
