// The six ray classes of the benchmark, from one view of a scene. Everything is a function of the
// view, the surface points and the seed: two runs trace the same bits.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "host/kernel/variants.hpp"
#include "scenes/scene.hpp"
#include "shared/camera.h"
#include "shared/ray.h"

namespace macula::bench {

// t_max of rays without an end.
inline constexpr float kFar = 1e30f;

// Rays of one class, packed densely in the order in which a frame would list them. Lanes of the
// last block beyond `count` are inactive.
struct RaySet {
    kernel::RayClass ray_class = kernel::RayClass::primary;
    std::uint32_t count = 0;
    std::vector<shared::RayBlock> blocks;

    void append(const glm::vec3& origin, const glm::vec3& direction, float t_min, float t_max);
    glm::vec3 origin(std::uint32_t ray) const;
    glm::vec3 direction(std::uint32_t ray) const;
    float t_min(std::uint32_t ray) const;
    float t_max(std::uint32_t ray) const;
};

// Shadow and ambient occlusion ask for any hit, the others for the closest.
bool is_any_hit(kernel::RayClass ray_class);
// Neighbouring rays of the class are similar (Embree's coherent flag).
bool is_coherent(kernel::RayClass ray_class);

// A view whose pixels are square at the image's centre.
shared::Camera pinhole(const glm::vec3& eye, const glm::vec3& target, const glm::vec3& up,
                       float vertical_fov_degrees, float aspect);
// The left eye of an Oculus DK2 as in Weier et al. 2016, at the same place and axis as `view`.
inline constexpr std::uint32_t kDk2Width = 1182, kDk2Height = 1464;
shared::Camera dk2_left(const shared::Camera& view);

// Unit direction through the centre of a pixel of a width x height image; row 0 is the top.
glm::vec3 pixel_direction(const shared::Camera& camera, glm::uvec2 pixel, std::uint32_t width,
                          std::uint32_t height);

// Pixels of a width x height image in the engine's order: tiles of 32 x 32 row by row, in each the
// packets of 4 x 4 in Morton order, in each the pixels row by row; what lies outside is left out.
std::vector<glm::uvec2> pixel_order(std::uint32_t width, std::uint32_t height);

// One ray through the centre of every pixel of a size x size image.
RaySet primary_rays(const shared::Camera& camera, std::uint32_t size);

// Foveal region configuration of Weier et al. 2016, section 3.2: eccentricities in degrees.
struct FovealRegion {
    float r0 = 10.0f, r1 = 20.0f, p_min = 0.05f;
};
// 1 up to r0, p_min from r1 on, linear between.
float foveal_probability(const FovealRegion& region, float eccentricity_degrees);

// The pixels that Weier's sampling picks with the gaze at the image's axis, and every pixel that
// holds a sample of a support grid of support_width x support_height.
RaySet sparse_rays(const shared::Camera& camera, std::uint32_t width, std::uint32_t height,
                   std::uint32_t support_width, std::uint32_t support_height,
                   const FovealRegion& region, std::uint64_t seed);

// Where a primary ray hit. `normal` is geometric, of unit length, on the side of the ray's origin.
struct SurfacePoint {
    glm::vec3 position, normal;
};

// Towards the light's centre, from 1e-5 diagonals above the surface to 0.1 % before the light.
RaySet shadow_rays(std::span<const SurfacePoint> points, const glm::vec3& light, float diagonal);
// Cosine-distributed about the normal; `radius` in world units.
RaySet ambient_occlusion_rays(std::span<const SurfacePoint> points, float radius, float diagonal,
                              std::uint64_t seed);
RaySet diffuse_rays(std::span<const SurfacePoint> points, float diagonal, std::uint64_t seed);
// Origins uniform in the bounds, directions uniform on the sphere.
RaySet random_rays(const scene::Bounds& bounds, std::uint32_t count, std::uint64_t seed);

} // namespace macula::bench
