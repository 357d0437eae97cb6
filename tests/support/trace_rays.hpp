// Rays for the scenes of trace_scenes.hpp.
#pragma once

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "bvh/ray_blocks.hpp"
#include "bvh/reference.hpp"
#include "tests/support/trace_scenes.hpp"

namespace macula::test {

inline bvh::Ray ray(glm::vec3 o, glm::vec3 d, float t_min = 0.0f, float t_max = 1e30f) {
    return {{o.x, o.y, o.z}, {d.x, d.y, d.z}, t_min, t_max};
}

// A pinhole's rays in 4 x 4 packets.
inline std::vector<bvh::Ray> coherent_rays(std::uint32_t count, glm::vec3 eye, glm::vec3 target,
                                           float width) {
    std::vector<bvh::Ray> rays;
    const auto side = static_cast<std::uint32_t>(std::ceil(std::sqrt(count / 16.0f)));
    const glm::vec3 forward = glm::normalize(target - eye);
    const glm::vec3 right = glm::normalize(glm::cross(forward, glm::vec3(0.1f, 1.0f, 0.2f)));
    const glm::vec3 up = glm::cross(right, forward);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t packet = i / 16;
        const auto x = static_cast<float>(packet % side * 4 + i % 4);
        const auto y = static_cast<float>(packet / side * 4 + i / 4 % 4);
        const float scale = width / static_cast<float>(4 * side);
        rays.push_back(ray(eye, forward + right * (x * scale - 0.5f * width) +
                                    up * (y * scale - 0.5f * width)));
    }
    return rays;
}

inline std::vector<bvh::Ray> random_rays(std::uint32_t count, float reach, std::uint32_t seed) {
    Random random(seed);
    std::vector<bvh::Ray> rays;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec3 origin = random.point(-reach, reach);
        const glm::vec3 direction = random.point(-1, 1) * (i % 5 == 0 ? 100.0f : 1.0f);
        rays.push_back(ray(origin, direction, i % 3 == 0 ? 0.2f : 0.0f,
                           i % 4 == 0 ? random(0.1f, 2.0f) : 1e30f));
    }
    return rays;
}

// In planes, along edges, through vertices, with zero components, from the surface itself.
inline std::vector<bvh::Ray> lattice_rays() {
    std::vector<bvh::Ray> rays;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float sign : {-1.0f, 1.0f}) {
            for (int i = 0; i < 81; ++i) {
                glm::vec3 origin(0.0f), along(0.0f);
                origin[axis] = -3.0f * sign;
                origin[(axis + 1) % 3] = static_cast<float>(i % 9) * 0.5f - 2.0f;
                origin[(axis + 2) % 3] = static_cast<float>(i / 9) * 0.5f - 2.0f;
                along[axis] = sign;
                rays.push_back(ray(origin, along));
                rays.push_back(ray(origin, glm::vec3(0.0f) - origin));
                rays.push_back(ray(origin, along + glm::vec3(-0.0f, 0.0f, -0.0f), 1.0f, 1.0f));
                along[(axis + 1) % 3] = 1.0f;
                rays.push_back(ray(origin, along));
                rays.push_back(ray(origin + along, along));
            }
        }
    }
    return rays;
}

// Rays that no caller should make, between ones that any would.
inline std::vector<bvh::Ray> odd_rays() {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr float largest = std::numeric_limits<float>::max();
    constexpr float denormal = std::numeric_limits<float>::denorm_min();
    const glm::vec3 o(0.1f, 0.2f, -3.0f), d(0.05f, -0.1f, 1.0f);
    std::vector<bvh::Ray> odd = {
        ray({nan, 0, 0}, d),
        ray(o, {nan, 0, 1}),
        ray(o, {0, nan, 1}),
        ray(o, {0, 0, nan}),
        ray(o, {nan, nan, nan}),
        ray(o, {0, 0, 0}),
        ray(o, d, nan, 1.0f),
        ray(o, d, 0.0f, nan),
        ray(o, d, 2.0f, 1.0f),
        ray(o, d, -1.0f, 1e30f),
        ray(o, d, 0.0f, infinity),
        ray(o, d, 0.0f, largest),
        ray(o, d, 0.0f, 0.0f),
        ray(o, d, 3.0f, 3.0f),
        ray(o, {0, 0, denormal}),
        ray(o, {1e-20f, 0, 1}),
        ray(o, {0, 0, 1e10f}),
        ray({0, 0, 0}, {0, 0, 1}),
        ray({1e6f, 1e6f, 1e6f}, {-1, -1, -1}),
        ray(o, {-0.0f, -0.0f, 1}),
    };
    std::vector<bvh::Ray> rays;
    Random random(9);
    for (const bvh::Ray& each : odd) {
        rays.push_back(each);
        for (int i = 0; i < 6; ++i)
            rays.push_back(ray(o, d + random.point(-0.2f, 0.2f)));
    }
    return rays;
}

} // namespace macula::test
