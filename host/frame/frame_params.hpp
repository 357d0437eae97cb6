// From the scene's camera, the display and the frame index to the one struct that every kernel of a
// frame reads. All arithmetic is that of the kernels: the same parameters on every platform.
#pragma once

#include <cstdint>
#include <optional>

#include "scenes/scene.hpp"
#include "shared/camera.h"

namespace macula::frame {

// Of the four half angles of the field of view, all > 0 (shared/camera.h).
struct Tangents {
    float left = 0.0f, right = 0.0f, up = 0.0f, down = 0.0f;
};

// A symmetric view with square pixels. Throws std::invalid_argument unless 0 < fov < 180.
Tangents tangents_of(float vertical_fov_degrees, std::uint32_t width, std::uint32_t height);

// Throws std::invalid_argument when the camera's axes are not defined (eye = target, up along the
// view) or a number is not finite. A view along `up` takes another up axis instead.
shared::Camera make_camera(const scene::Camera& view, const Tangents& tangents);

// The scene's camera in frame `frame` of its path; its first camera where it has no path. Frames
// beyond the end stay at the end.
scene::Camera camera_on_path(const scene::Scene& scene, std::uint32_t frame);
// The same between frames.
scene::Camera camera_at(const scene::Scene& scene, float frame);

struct FrameSettings {
    std::uint32_t width = 640, height = 480; // pixels, each 1..16384
    std::uint32_t samples_per_pixel = 1;     // 1..65536
    std::uint32_t seed = 0;
    std::uint32_t light_count = 0;
    std::uint32_t ambient_occlusion_samples = 0; // 0: none; at most 4096
    float ambient_occlusion_radius = 1.0f;       // world units, > 0
    float ambient[3] = {0.0f, 0.0f, 0.0f};       // radiance
    float background[3] = {0.0f, 0.0f, 0.0f};    // radiance
    std::uint32_t jitter_phases = 0;             // frames until the jitter repeats; 0: none
    float sharpening = 1.0f; // textures are filtered for pixels this much narrower, at most 1
    float lod_bias = 0.0f;   // levels that every texture lookup goes up, -16..16
};

// Throws std::invalid_argument that names the setting out of range.
void check(const FrameSettings& settings);

// Samples move within their pixels along Halton's sequence in the bases 2 and 3.
struct Jitter {
    float x = 0.0f, y = 0.0f; // from the pixel's middle, -0.5..0.5 pixels
};
Jitter jitter_of(std::uint32_t frame, std::uint32_t phases);

// Where the eye looks in one frame.
struct Gaze {
    // World space, of any length above 0; the camera's forward axis without one.
    std::optional<glm::vec3> direction;
    // Factor on the foveal region's radii, at least 1: more where the gaze is not known for sure.
    float widening = 1.0f;
};

// `previous`: last frame's camera; without one the view stands still. Throws std::invalid_argument
// for a gaze without direction or a widening out of 1..100.
shared::FrameParams make_params(const FrameSettings& settings, std::uint32_t frame,
                                const shared::Camera& camera,
                                const std::optional<shared::Camera>& previous,
                                const Gaze& gaze = {});

} // namespace macula::frame
