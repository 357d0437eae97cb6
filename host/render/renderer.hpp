// The engine in one class: a scene on a device, rendered frame by frame into memory.
//
//     compute::Device device = compute::open("");
//     const scene::Scene scene = scene::load("cornell");
//     render::Renderer renderer(device, scene, {.width = 512, .height = 512});
//     const render::FrameReport report = renderer.render(0);
//     const render::Image colour = renderer.map("colour");
//     use(colour.floats, colour.width, colour.height, colour.components);
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/cl/device.hpp"
#include "host/frame/frame_params.hpp"
#include "host/frame/geometry.hpp"
#include "host/frame/lights.hpp"
#include "host/frame/timings.hpp"
#include "host/kernel/variants.hpp"
#include "host/method/method.hpp"
#include "host/render/device_scene.hpp"
#include "host/stage/foveated.hpp"
#include "host/stage/lens.hpp"
#include "host/stage/log_polar.hpp"
#include "host/stage/rrm.hpp"
#include "scenes/scene.hpp"

namespace macula::render {

struct Options {
    std::uint32_t width = 640, height = 480; // pixels, each 1..16384
    std::string method = "full";             // method::methods()
    frame::LightMode lights = frame::LightMode::point;
    // Rays for each area light, 1..4096; without one frame::default_light_samples().
    std::optional<std::uint32_t> light_samples;
    std::uint32_t ambient_occlusion_samples = 16; // 1..4096
    float ambient_occlusion_radius = 0.0f;        // world units; 0: the scene's
    std::uint32_t samples_per_pixel = 1;          // 1..65536
    float lod_bias = 0.0f; // levels that every texture lookup goes up, -16..16; below
                           // 0 only for methods that do not foveate
    std::uint32_t seed = 0;
    std::uint32_t depth = 1;  // levels of reflected and refracted rays, 0..16
    std::uint32_t layers = 4; // blended surfaces kept along a ray, 1..16
    std::uint32_t lanes = 0; // ray slots to a work-item of the shading kernels: 1, 16; 0: by device
    std::string variant;     // a traversal variant for all rays; empty: chosen for device and rays
    // Of the display; without them the camera's vertical field of view and square pixels.
    std::optional<frame::Tangents> tangents;
    // Warps the picture for the display's lens; needs `tangents`.
    std::optional<stage::LensDistortion> lens;
    // Images wanted besides "colour": names of image_formats().
    std::vector<std::string> images;
    stage::WeierOptions weier;  // of method "weier"
    float lowres_scale = 0.46f; // of method "lowres": part of the pixels along each axis, 0..1
    stage::LogPolarOptions log_polar; // of method "logpolar"
    stage::RrmOptions rrm;            // of method "rrm"
    method::TemporalOptions temporal; // of methods "...+taa" and "...+upscale"
    stage::RingOptions rings;         // of method "lowres_rings"
    frame::GeometryOptions geometry;  // unless the scene is on the device already
    std::uint32_t warm_up_frames = 1; // that do not count in the statistics
};

// What an image holds. Rows run from the top, pixels from the left, without padding.
struct ImageFormat {
    const char* name;         // of the resource
    std::uint32_t components; // 32-bit words a pixel
    std::uint32_t used;       // of them with a meaning; the rest is 0 or 1
    bool integer;             // uint32 instead of float
    const char* meaning;      // with the unit
};
std::span<const ImageFormat> image_formats();

// An image in mapped device memory. While it lives, nothing may be rendered.
struct Image {
    std::uint32_t width = 0, height = 0, components = 0;
    bool integer = false;
    std::span<const float> floats;        // of a float image
    std::span<const std::uint32_t> words; // of any image: its bits
    compute::Mapped<const std::uint32_t> mapping;
};

struct FrameReport {
    std::uint32_t frame = 0;
    double wall_ms = 0.0; // from the first launch until the images are there
    std::vector<frame::StageTime> stages;
    // Rays by kernel::RayClass. Shadow rays: all samples of the surfaces that a light may reach.
    std::array<std::uint64_t, kernel::kRayClasses.size()> rays{};
    std::uint64_t total_rays() const;
};

class Renderer {
  public:
    // The scene must have passed validate(); it may be destroyed afterwards. Throws
    // std::invalid_argument for an option out of range and the device's errors.
    Renderer(const compute::Device& device, const scene::Scene& scene, const Options& options = {});
    // The same for a scene that is on a device already, and stays there while a renderer uses it.
    // Renderers that share one render each frame in turn. `scene`: the one that it was made from.
    Renderer(std::shared_ptr<DeviceScene> on_device, const scene::Scene& scene,
             const Options& options = {});
    ~Renderer();
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;

    // Renders frame `frame` from the scene's camera path (or first camera), or from `view`, and
    // waits for it. The view before it is that of the call before.
    FrameReport render(std::uint32_t frame);
    FrameReport render(std::uint32_t frame, const scene::Camera& view,
                       const frame::Gaze& gaze = {});
    // The two halves of render(): start() enqueues the frame and returns, finish() waits for it.
    // Renderers on different devices work at the same time between them.
    void start(std::uint32_t frame, const scene::Camera& view, const frame::Gaze& gaze = {});
    FrameReport finish();

    // An image of the last frame: "colour" or one of Options::images. Those have the size that is
    // rendered, the colour that of the picture. Throws std::invalid_argument for another name.
    Image map(const std::string& name) const;
    // What is to be shown: "colour", or "lens image" where Options::lens is given.
    Image picture() const;
    // 16 hexadecimal digits: XXH3 (64 bits) of the picture's bits.
    std::string hash() const;

    // Places the scene's instances anew for the next frame: one transform each. For scenes in which
    // nothing moves by itself (scene::Mover). That frame's
    // render() throws std::invalid_argument as frame::DeviceGeometry::set_transforms does.
    // Renderers that share a scene move it for one another.
    void set_transforms(std::span<const scene::Transform> world_from_object);
    // Forgets the last frame: its camera, the method's history and how objects moved. Renderers
    // that share a scene that moves are reset together, before the next frame of any.
    void reset();

    // Pictures depend on the frames before.
    bool has_history() const;

    const Options& options() const;
    const frame::Timings& timings() const;
    const frame::GeometryStatistics& geometry() const;
    // "wide8" and the like, for each ray class.
    std::string variant(kernel::RayClass ray_class) const;
    // The method's stages in words.
    std::string explain() const;

  private:
    Image image(const std::string& resource, const ImageFormat& format, method::Size size) const;

    struct State;
    std::unique_ptr<State> state_;
};

} // namespace macula::render
