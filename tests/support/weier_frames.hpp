// Method weier frame by frame, with every resource of its graph at hand.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "host/frame/frame_params.hpp"
#include "host/frame/surfaces.hpp"
#include "host/kernel/library.hpp"
#include "host/method/method.hpp"
#include "scenes/scene.hpp"

namespace macula::test {

struct WeierSetup {
    std::uint32_t width = 96, height = 80;
    frame::LightMode lights = frame::LightMode::point;
    std::uint32_t samples = 4; // of area lights and ambient occlusion
    std::optional<frame::Tangents> tangents;
    std::set<std::string> outputs;
    stage::WeierOptions weier;
    std::string method = "weier";
    float lowres_scale = 0.46f;
    stage::LogPolarOptions log_polar;
    method::TemporalOptions temporal;
    stage::RingOptions rings;
    stage::RrmOptions rrm;
    bool jitter = true; // where the method has it
    std::uint32_t samples_per_pixel = 1;
    frame::GeometryOptions geometry;
    std::uint32_t depth = 0; // of reflected and refracted rays
    std::uint32_t lanes = 1; // of the shading kernels, 1 or 16
};

// A gaze through a point of the image in pixels of WeierSetup's 96 x 80.
inline frame::Gaze gaze_through(const scene::Camera& view, float x, float y) {
    const auto camera =
        frame::make_camera(view, frame::tangents_of(view.vertical_fov_degrees, 96, 80));
    const float sx = x / 96.0f * (camera.tan_left + camera.tan_right) - camera.tan_left;
    const float sy = camera.tan_up - y / 80.0f * (camera.tan_up + camera.tan_down);
    glm::vec3 direction;
    for (int i = 0; i < 3; ++i)
        direction[i] = camera.right[i] * sx + camera.up[i] * sy + camera.forward[i];
    return {direction, 1.0f};
}

class WeierFrames {
  public:
    WeierFrames(const compute::Device& on, const scene::Scene& scene, const WeierSetup& setup)
        : device(on), setup_(setup), method_(method::find_method(setup.method)),
          size_(method_.render_size(setup.width, setup.height, setup.temporal)),
          geometry_(device, scene, setup.geometry), surfaces_(device, scene, geometry_.parts()),
          tracer_(device, library_, geometry_, stage::choose_variants(device)),
          lights_(frame::make_lights(scene, setup.lights, setup.samples)),
          totals_(device.upload(std::span(kNoRays), "ray counts")),
          graph_(method_.make({device, library_, geometry_, surfaces_, tracer_, size_.width,
                               size_.height, lights_, occlusion() ? setup.samples : 0, false,
                               totals_, setup.lanes, setup.width, setup.height, setup.depth},
                              {setup.lights, setup.weier, setup.lowres_scale, setup.log_polar,
                               setup.temporal, setup.rings, setup.rrm})) {
        std::set<std::string> outputs = setup.outputs;
        outputs.insert("colour");
        outputs.insert(method_.picture());
        graph_.compile(device, outputs);
    }

    // `gaze`: world space; straight ahead without one.
    void run(std::uint32_t frame, const scene::Camera& view, const frame::Gaze& gaze = {}) {
        frame::FrameSettings s;
        s.width = size_.width;
        s.height = size_.height;
        s.samples_per_pixel = setup_.samples_per_pixel;
        if (setup_.jitter)
            s.jitter_phases = method_.jitter_phases(setup_.width, setup_.temporal);
        s.light_count = static_cast<std::uint32_t>(lights_.size());
        s.ambient_occlusion_samples = occlusion() ? setup_.samples : 0;
        for (float& ambient : s.ambient)
            ambient = occlusion() ? 1.0f : 0.2f;
        const auto tangents = setup_.tangents.value_or(
            frame::tangents_of(view.vertical_fov_degrees, setup_.width, setup_.height));
        const shared::Camera camera = frame::make_camera(view, tangents);
        params = frame::make_params(s, frame, camera, last_, gaze);
        last_ = camera;
        graph_.execute(params);
        device.finish();
    }

    // The next frame is a first one.
    void forget() {
        last_.reset();
        graph_.forget();
    }
    void place(std::span<const scene::Transform> world_from_object) {
        geometry_.set_transforms(world_from_object);
    }
    const char* picture() const { return method_.picture(); }

    template <class T>
    std::vector<T> read(const std::string& name) const {
        const auto mapped = graph_.result(name).map_read<T>();
        return {mapped.begin(), mapped.end()};
    }
    // A handle of the resource, for tampering with it.
    compute::Buffer buffer(const std::string& name) const { return graph_.result(name); }
    std::uint64_t rays(kernel::RayClass ray_class) const {
        return totals_.read_one<std::uint64_t>(static_cast<std::uint64_t>(ray_class));
    }

    compute::Device device;
    shared::FrameParams params{};

  private:
    static constexpr std::array<std::uint64_t, kernel::kRayClasses.size()> kNoRays{};

    bool occlusion() const { return setup_.lights == frame::LightMode::ambient_occlusion; }

    WeierSetup setup_;
    const method::Method& method_;
    method::Size size_;
    kernel::Library library_;
    frame::DeviceGeometry geometry_;
    frame::DeviceSurfaces surfaces_;
    stage::Tracer tracer_;
    std::vector<shared::Light> lights_;
    compute::Buffer totals_;
    frame::Graph graph_;
    std::optional<shared::Camera> last_;
};

} // namespace macula::test
