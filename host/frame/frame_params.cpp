#include "host/frame/frame_params.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "lib/sampling.h"
#include "scenes/camera_path.hpp"

namespace macula::frame {
namespace {

using shared::float3;

float3 to_float3(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

void store(float3 v, float (&out)[3]) {
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

bool is_finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// The digits of `index` mirrored at the point (Halton 1964).
double radical_inverse(std::uint32_t index, std::uint32_t base) {
    double value = 0.0, place = 1.0;
    for (; index > 0; index /= base) {
        place /= base;
        value += place * (index % base);
    }
    return value;
}

// N when count = N * N, else 0.
std::uint32_t grid_side(std::uint32_t count) {
    std::uint32_t side = 1;
    while (side * side < count)
        ++side;
    return side * side == count ? side : 0;
}

void check_range(const char* what, std::uint32_t value, std::uint32_t least, std::uint32_t most) {
    if (value < least || value > most)
        throw std::invalid_argument(
            fmt::format("{} must be {} to {}, not {}", what, least, most, value));
}

// Expects the camera to be set.
void store_gaze(const Gaze& gaze, shared::FrameParams& p) {
    constexpr float kMaxWidening = 100.0f;
    if (!(gaze.widening >= 1.0f && gaze.widening <= kMaxWidening))
        throw std::invalid_argument(fmt::format(
            "the foveal region can be widened by 1 to {}, not {}", kMaxWidening, gaze.widening));
    p.gaze_widening = gaze.widening;
    const float3 forward = {p.camera.forward[0], p.camera.forward[1], p.camera.forward[2]};
    if (!gaze.direction) {
        store(forward, p.gaze);
        return;
    }
    const float3 zero = {0.0f, 0.0f, 0.0f};
    const float3 direction =
        is_finite(*gaze.direction) ? unit3(to_float3(*gaze.direction), zero) : zero;
    if (dot3(direction, direction) == 0.0f)
        throw std::invalid_argument("the gaze has no direction");
    store(direction, p.gaze);
}

} // namespace

Tangents tangents_of(float vertical_fov_degrees, std::uint32_t width, std::uint32_t height) {
    if (!(vertical_fov_degrees > 0.0f && vertical_fov_degrees < 180.0f))
        throw std::invalid_argument(
            fmt::format("a vertical field of view must be above 0 and below 180 degrees, not {}",
                        vertical_fov_degrees));
    float cosine = 1.0f;
    const float sine = shared::m_sin_cos_pi(vertical_fov_degrees / 360.0f, &cosine);
    const float up = sine / cosine;
    const float side = up * (static_cast<float>(width) / static_cast<float>(height));
    return {side, side, up, up};
}

shared::Camera make_camera(const scene::Camera& view, const Tangents& tangents) {
    if (!is_finite(view.eye) || !is_finite(view.target) || !is_finite(view.up))
        throw std::invalid_argument("camera \"" + view.name + "\" has a number that is not finite");
    const float3 zero = {0.0f, 0.0f, 0.0f};
    const float3 forward = unit3(to_float3(view.target) - to_float3(view.eye), zero);
    if (dot3(forward, forward) == 0.0f)
        throw std::invalid_argument("camera \"" + view.name + "\" looks at its own position");
    float3 right = cross3(forward, unit3(to_float3(view.up), zero));
    // Looking along the up axis: any other axis gives an image.
    if (dot3(right, right) < 1e-12f)
        right = cross3(forward, std::fabs(forward.z) < 0.9f ? float3{0.0f, 0.0f, 1.0f}
                                                            : float3{1.0f, 0.0f, 0.0f});
    right = unit3(right, zero);
    shared::Camera camera{};
    store(to_float3(view.eye), camera.origin);
    store(forward, camera.forward);
    store(right, camera.right);
    store(unit3(cross3(right, forward), zero), camera.up);
    camera.tan_left = tangents.left;
    camera.tan_right = tangents.right;
    camera.tan_up = tangents.up;
    camera.tan_down = tangents.down;
    for (const float t : {tangents.left, tangents.right, tangents.up, tangents.down})
        if (!(t > 0.0f && t < 1e6f))
            throw std::invalid_argument(
                fmt::format("a field-of-view tangent must be above 0 and finite, not {}", t));
    return camera;
}

scene::Camera camera_on_path(const scene::Scene& scene, std::uint32_t frame) {
    return camera_at(scene, static_cast<float>(frame));
}

scene::Camera camera_at(const scene::Scene& scene, float frame) {
    scene::Camera camera = scene.cameras.empty() ? scene::Camera{} : scene.cameras.front();
    if (scene.path.keys.empty())
        return camera;
    const scene::CameraView view = scene::view_at(scene.path, frame);
    camera.eye = view.eye;
    camera.target = view.target;
    return camera;
}

Jitter jitter_of(std::uint32_t frame, std::uint32_t phases) {
    if (phases == 0)
        return {};
    const std::uint32_t index = frame % phases + 1;
    return {static_cast<float>(radical_inverse(index, 2) - 0.5),
            static_cast<float>(radical_inverse(index, 3) - 0.5)};
}

void check(const FrameSettings& s) {
    check_range("the width", s.width, 1, 16384);
    check_range("the height", s.height, 1, 16384);
    check_range("samples per pixel", s.samples_per_pixel, 1, 65536);
    if (!(std::fabs(s.lod_bias) <= 16.0f))
        throw std::invalid_argument(
            fmt::format("the bias of texture levels must be -16 to 16, not {}", s.lod_bias));
    check_range("ambient occlusion samples", s.ambient_occlusion_samples, 0, 4096);
    if (s.ambient_occlusion_samples > 0 &&
        !(s.ambient_occlusion_radius > 0.0f && s.ambient_occlusion_radius < 1e18f))
        throw std::invalid_argument(fmt::format(
            "the ambient occlusion radius must be above 0, not {}", s.ambient_occlusion_radius));
}

shared::FrameParams make_params(const FrameSettings& settings, std::uint32_t frame,
                                const shared::Camera& camera,
                                const std::optional<shared::Camera>& previous, const Gaze& gaze) {
    check(settings);
    shared::FrameParams p{};
    p.camera = camera;
    p.previous_camera = previous.value_or(camera);
    p.width = settings.width;
    p.height = settings.height;
    p.frame = frame;
    p.seed = settings.seed;
    p.samples_per_pixel = settings.samples_per_pixel;
    p.sample_grid = grid_side(settings.samples_per_pixel);
    p.light_count = settings.light_count;
    p.ambient_occlusion_samples = settings.ambient_occlusion_samples;
    p.ambient_occlusion_columns = settings.ambient_occlusion_samples > 0
                                      ? shared::strata_columns(settings.ambient_occlusion_samples)
                                      : 1;
    p.ambient_occlusion_radius = settings.ambient_occlusion_radius;
    // Each of the pixel's samples stands for its share of the pixel's area.
    p.pixel_spread = (camera.tan_left + camera.tan_right) / static_cast<float>(settings.width) /
                     std::sqrt(static_cast<float>(settings.samples_per_pixel));
    p.lod_bias = settings.lod_bias + shared::m_log2(settings.sharpening);
    const Jitter jitter = jitter_of(frame, settings.jitter_phases);
    p.jitter[0] = jitter.x;
    p.jitter[1] = jitter.y;
    store_gaze(gaze, p);
    for (int i = 0; i < 3; ++i) {
        p.ambient[i] = settings.ambient[i];
        p.background[i] = settings.background[i];
    }
    return p;
}

} // namespace macula::frame
