#include "bench/rays.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace macula::bench {
namespace {

constexpr std::uint32_t kLanes = MACULA_RAY_BLOCK;
// Secondary rays start this many scene diagonals above the surface.
constexpr float kOffset = 1e-5f;

// splitmix64 (Steele et al. 2014) of a counter: uniform in [0, 1) with 24 bits.
float uniform(std::uint64_t seed, std::uint64_t index, std::uint64_t dimension) {
    std::uint64_t z = seed * 0x9e3779b97f4a7c15ULL + index * 8 + dimension + 1;
    z *= 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    z ^= z >> 31;
    return static_cast<float>(z >> 40) * 0x1p-24f;
}

// Direction about `normal` with a density proportional to the cosine (Malley's method).
glm::vec3 cosine_direction(const glm::vec3& normal, float a, float b) {
    const glm::vec3 helper =
        std::abs(normal.x) > 0.5f ? glm::vec3(0.0f, 1.0f, 0.0f) : glm::vec3(1.0f, 0.0f, 0.0f);
    const glm::vec3 tangent = glm::normalize(glm::cross(normal, helper));
    const glm::vec3 bitangent = glm::cross(normal, tangent);
    const float radius = std::sqrt(a), angle = 2.0f * std::numbers::pi_v<float> * b;
    return glm::normalize(tangent * (radius * std::cos(angle)) +
                          bitangent * (radius * std::sin(angle)) +
                          normal * std::sqrt(std::max(0.0f, 1.0f - a)));
}

RaySet hemisphere_rays(kernel::RayClass ray_class, std::span<const SurfacePoint> points,
                       float t_max, float diagonal, std::uint64_t seed) {
    RaySet rays;
    rays.ray_class = ray_class;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::vec3 origin = points[i].position + points[i].normal * (kOffset * diagonal);
        const glm::vec3 direction =
            cosine_direction(points[i].normal, uniform(seed, i, 0), uniform(seed, i, 1));
        rays.append(origin, direction, 0.0f, t_max);
    }
    return rays;
}

} // namespace

void RaySet::append(const glm::vec3& o, const glm::vec3& d, float near, float far) {
    const std::uint32_t lane = count++ % kLanes;
    if (lane == 0) {
        shared::RayBlock empty{};
        std::fill_n(empty.t_max, kLanes, -1.0f);
        std::fill_n(empty.direction_x, kLanes, 1.0f);
        blocks.push_back(empty);
    }
    shared::RayBlock& block = blocks.back();
    block.origin_x[lane] = o.x;
    block.origin_y[lane] = o.y;
    block.origin_z[lane] = o.z;
    block.direction_x[lane] = d.x;
    block.direction_y[lane] = d.y;
    block.direction_z[lane] = d.z;
    block.t_min[lane] = near;
    block.t_max[lane] = far;
}

glm::vec3 RaySet::origin(std::uint32_t ray) const {
    const shared::RayBlock& b = blocks[ray / kLanes];
    const std::uint32_t l = ray % kLanes;
    return {b.origin_x[l], b.origin_y[l], b.origin_z[l]};
}

glm::vec3 RaySet::direction(std::uint32_t ray) const {
    const shared::RayBlock& b = blocks[ray / kLanes];
    const std::uint32_t l = ray % kLanes;
    return {b.direction_x[l], b.direction_y[l], b.direction_z[l]};
}

float RaySet::t_min(std::uint32_t ray) const {
    return blocks[ray / kLanes].t_min[ray % kLanes];
}

float RaySet::t_max(std::uint32_t ray) const {
    return blocks[ray / kLanes].t_max[ray % kLanes];
}

bool is_any_hit(kernel::RayClass ray_class) {
    return ray_class == kernel::RayClass::shadow ||
           ray_class == kernel::RayClass::ambient_occlusion;
}

bool is_coherent(kernel::RayClass ray_class) {
    return ray_class == kernel::RayClass::primary || ray_class == kernel::RayClass::shadow ||
           ray_class == kernel::RayClass::sparse;
}

RaySet shadow_rays(std::span<const SurfacePoint> points, const glm::vec3& light, float diagonal) {
    RaySet rays;
    rays.ray_class = kernel::RayClass::shadow;
    for (const SurfacePoint& point : points) {
        const glm::vec3 origin = point.position + point.normal * (kOffset * diagonal);
        const float distance = glm::length(light - origin);
        // A point in the light itself sees it: such a ray has no direction.
        if (distance > 0.0f)
            rays.append(origin, (light - origin) / distance, 0.0f, distance * 0.999f);
    }
    return rays;
}

RaySet ambient_occlusion_rays(std::span<const SurfacePoint> points, float radius, float diagonal,
                              std::uint64_t seed) {
    return hemisphere_rays(kernel::RayClass::ambient_occlusion, points, radius, diagonal, seed);
}

RaySet diffuse_rays(std::span<const SurfacePoint> points, float diagonal, std::uint64_t seed) {
    return hemisphere_rays(kernel::RayClass::diffuse, points, kFar, diagonal, seed);
}

RaySet random_rays(const scene::Bounds& bounds, std::uint32_t count, std::uint64_t seed) {
    RaySet rays;
    rays.ray_class = kernel::RayClass::random;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec3 where(uniform(seed, i, 0), uniform(seed, i, 1), uniform(seed, i, 2));
        const float z = 2.0f * uniform(seed, i, 3) - 1.0f;
        const float radius = std::sqrt(std::max(0.0f, 1.0f - z * z));
        const float angle = 2.0f * std::numbers::pi_v<float> * uniform(seed, i, 4);
        rays.append(bounds.lo + where * (bounds.hi - bounds.lo),
                    {radius * std::cos(angle), radius * std::sin(angle), z}, 0.0f, kFar);
    }
    return rays;
}

RaySet sparse_rays(const shared::Camera& camera, std::uint32_t width, std::uint32_t height,
                   std::uint32_t support_width, std::uint32_t support_height,
                   const FovealRegion& region, std::uint64_t seed) {
    std::vector<std::uint8_t> wanted(std::size_t{width} * height);
    for (std::uint32_t j = 0; j < support_height; ++j) {
        for (std::uint32_t i = 0; i < support_width; ++i) {
            const std::uint64_t x = (2ULL * i + 1) * width / (2ULL * support_width);
            const std::uint64_t y = (2ULL * j + 1) * height / (2ULL * support_height);
            wanted[y * width + x] = 1;
        }
    }
    RaySet rays;
    rays.ray_class = kernel::RayClass::sparse;
    const glm::vec3 eye(camera.origin[0], camera.origin[1], camera.origin[2]);
    const glm::vec3 axis(camera.forward[0], camera.forward[1], camera.forward[2]);
    for (const glm::uvec2 pixel : pixel_order(width, height)) {
        const glm::vec3 direction = pixel_direction(camera, pixel, width, height);
        const float cosine = std::clamp(glm::dot(direction, axis), -1.0f, 1.0f);
        const float eccentricity = glm::degrees(std::acos(cosine));
        const std::size_t index = std::size_t{pixel.y} * width + pixel.x;
        if (wanted[index] != 0 ||
            uniform(seed, index, 5) < foveal_probability(region, eccentricity))
            rays.append(eye, direction, 0.0f, kFar);
    }
    return rays;
}

} // namespace macula::bench
