#include "bench/rays.hpp"

#include <algorithm>
#include <cmath>

namespace macula::bench {
namespace {

constexpr std::uint32_t kTile = 32, kPacket = 4, kPacketsOfTile = 64;

// Every second bit of a packet's Morton index, from `shift` on: its column or row in the tile.
std::uint32_t every_second_bit(std::uint32_t morton, std::uint32_t shift) {
    morton >>= shift;
    return (morton & 1u) | ((morton >> 1) & 2u) | ((morton >> 2) & 4u);
}

void store(float (&out)[3], const glm::vec3& v) {
    for (int i = 0; i < 3; ++i)
        out[i] = v[i];
}

} // namespace

shared::Camera pinhole(const glm::vec3& eye, const glm::vec3& target, const glm::vec3& up,
                       float vertical_fov_degrees, float aspect) {
    shared::Camera camera{};
    const glm::vec3 forward = glm::normalize(target - eye);
    // A view along `up` has no horizon of its own; any axis across it will do.
    const glm::vec3 across = glm::cross(forward, up);
    const glm::vec3 right = glm::length(across) > 1e-6f
                                ? glm::normalize(across)
                                : glm::normalize(glm::cross(forward, glm::vec3(0, 0, 1)));
    store(camera.origin, eye);
    store(camera.forward, forward);
    store(camera.right, right);
    store(camera.up, glm::cross(right, forward));
    camera.tan_up = camera.tan_down = std::tan(glm::radians(vertical_fov_degrees) * 0.5f);
    camera.tan_left = camera.tan_right = camera.tan_up * aspect;
    return camera;
}

shared::Camera dk2_left(const shared::Camera& view) {
    shared::Camera camera = view;
    camera.tan_up = camera.tan_down = 1.3299f;
    camera.tan_left = 1.0586f;
    camera.tan_right = 1.0924f;
    return camera;
}

glm::vec3 pixel_direction(const shared::Camera& camera, glm::uvec2 pixel, std::uint32_t width,
                          std::uint32_t height) {
    const float x = static_cast<float>(pixel.x) + 0.5f, y = static_cast<float>(pixel.y) + 0.5f;
    const float sx =
        x * (camera.tan_left + camera.tan_right) / static_cast<float>(width) - camera.tan_left;
    const float sy =
        camera.tan_up - y * (camera.tan_up + camera.tan_down) / static_cast<float>(height);
    glm::vec3 direction;
    for (int i = 0; i < 3; ++i)
        direction[i] = camera.right[i] * sx + camera.up[i] * sy + camera.forward[i];
    return glm::normalize(direction);
}

std::vector<glm::uvec2> pixel_order(std::uint32_t width, std::uint32_t height) {
    std::vector<glm::uvec2> order;
    order.reserve(std::size_t{width} * height);
    const auto visit_packet = [&](std::uint32_t x0, std::uint32_t y0) {
        for (std::uint32_t y = y0; y < std::min(y0 + kPacket, height); ++y) {
            for (std::uint32_t x = x0; x < std::min(x0 + kPacket, width); ++x)
                order.emplace_back(x, y);
        }
    };
    for (std::uint32_t ty = 0; ty < height; ty += kTile) {
        for (std::uint32_t tx = 0; tx < width; tx += kTile) {
            for (std::uint32_t m = 0; m < kPacketsOfTile; ++m)
                visit_packet(tx + every_second_bit(m, 0) * kPacket,
                             ty + every_second_bit(m, 1) * kPacket);
        }
    }
    return order;
}

RaySet primary_rays(const shared::Camera& camera, std::uint32_t size) {
    RaySet rays;
    rays.ray_class = kernel::RayClass::primary;
    rays.blocks.reserve((std::size_t{size} * size + 15) / 16);
    const glm::vec3 eye(camera.origin[0], camera.origin[1], camera.origin[2]);
    for (const glm::uvec2 pixel : pixel_order(size, size))
        rays.append(eye, pixel_direction(camera, pixel, size, size), 0.0f, kFar);
    return rays;
}

float foveal_probability(const FovealRegion& region, float eccentricity_degrees) {
    if (eccentricity_degrees <= region.r0)
        return 1.0f;
    if (eccentricity_degrees >= region.r1)
        return region.p_min;
    const float f = (eccentricity_degrees - region.r0) / (region.r1 - region.r0);
    return 1.0f + f * (region.p_min - 1.0f);
}

} // namespace macula::bench
