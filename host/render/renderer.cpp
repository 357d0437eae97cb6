#include "host/render/renderer.hpp"

#include <algorithm>
#include <chrono>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <xxhash.h>

#include "host/method/method.hpp"

namespace macula::render {
namespace {

constexpr const char* kLensImage = "lens image";

constexpr std::array kFormats = {
    ImageFormat{"colour", 4, 3, false, "linear RGB radiance, mean of the samples"},
    ImageFormat{"albedo", 4, 3, false, "diffuse reflectance, linear RGB, mean of the samples"},
    ImageFormat{"irradiance", 4, 3, false, "direct light over pi, linear RGB, mean"},
    ImageFormat{"ambient occlusion", 1, 1, false, "part of the hemisphere that is open, mean"},
    ImageFormat{"depth", 1, 1, false, "along the view axis, world units; 1e30: background"},
    ImageFormat{"position", 4, 3, false, "world space"},
    ImageFormat{"geometric normal", 4, 3, false, "unit, towards the viewer; 0: background"},
    ImageFormat{"shading normal", 4, 3, false, "unit, interpolated and mapped; 0: background"},
    ImageFormat{"triangle", 1, 1, true, "scene-wide id; 4294967295: background"},
    ImageFormat{"material", 1, 1, true, "index; 4294967295: background"},
    ImageFormat{"motion", 2, 2, false, "pixels: last frame's position minus this frame's"},
    // Of method weier (host/stage/show.hpp).
    ImageFormat{"reprojected colour", 4, 3, false, "last frame's colour in this view; 0: none"},
    ImageFormat{"support colour", 4, 3, false, "linear RGB of the nearest support sample"},
    ImageFormat{"sampling", 1, 1, true, "0: not sampled, 1: blended, 2: taken as it is"},
    ImageFormat{"resampling", 1, 1, true,
                "1 depth, 2 luminance, 4 grazing, 8 stretched, 16 new: sum"},
    ImageFormat{"cache age", 1, 1, true, "frames since the last sample; 1048575: none"},
    ImageFormat{"rho", 1, 1, false, "samples that the colour is worth"},
    // Where Options::lens is given.
    ImageFormat{kLensImage, 4, 3, false, "colour, warped for the lens; 0 outside of the view"},
};

constexpr std::uint32_t kMaxDepth = 16, kMaxLayers = 16;

bool has_highlights(const scene::Scene& scene) {
    for (const scene::Material& m : scene.materials)
        if (m.specular.x > 0.0f || m.specular.y > 0.0f || m.specular.z > 0.0f)
            return true;
    return false;
}

frame::FrameSettings settings_of(const scene::Scene& scene, const Options& options,
                                 std::size_t lights) {
    const bool occlusion = options.lights == frame::LightMode::ambient_occlusion;
    const method::Method& method = method::find_method(options.method);
    const method::Size size = method.render_size(options.width, options.height, options.temporal);
    frame::FrameSettings s;
    s.width = size.width;
    s.height = size.height;
    s.jitter_phases = method.jitter_phases(options.width, options.temporal);
    s.samples_per_pixel = options.samples_per_pixel;
    s.seed = options.seed;
    s.lod_bias = options.lod_bias;
    // Textures are as sharp as in a picture of that size.
    s.sharpening = static_cast<float>(s.width) / static_cast<float>(options.width);
    s.light_count = static_cast<std::uint32_t>(lights);
    if (occlusion) {
        s.ambient_occlusion_samples = options.ambient_occlusion_samples;
        s.ambient_occlusion_radius = options.ambient_occlusion_radius > 0.0f
                                         ? options.ambient_occlusion_radius
                                         : frame::ambient_occlusion_radius(scene);
    }
    for (int i = 0; i < 3; ++i) {
        s.ambient[i] = occlusion ? 1.0f : scene.ambient[i];
        s.background[i] = scene.background[i];
    }
    frame::check(s);
    if (options.lod_bias < 0.0f && method.foveates())
        throw std::invalid_argument(fmt::format("a bias of texture levels below 0, {}, is for "
                                                "methods that do not foveate: {} would flicker",
                                                options.lod_bias, method.name));
    if (options.layers < 1 || options.layers > kMaxLayers)
        throw std::invalid_argument(
            fmt::format("layers {} is not between 1 and {}", options.layers, kMaxLayers));
    if (options.depth > kMaxDepth)
        throw std::invalid_argument(
            fmt::format("depth {} is not between 0 and {}", options.depth, kMaxDepth));
    if (occlusion && s.ambient_occlusion_samples == 0)
        throw std::invalid_argument("lights \"ao\" need at least one ambient occlusion sample");
    return s;
}

// What the renderer needs of a scene once its geometry is on the device.
scene::Scene views_of(const scene::Scene& scene) {
    scene::Scene views;
    views.cameras = scene.cameras;
    views.path = scene.path;
    return views;
}

// A setting out of range is refused before the scene is built.
std::shared_ptr<DeviceScene> checked_scene(const compute::Device& device, const scene::Scene& scene,
                                           const Options& options) {
    settings_of(scene, options, 0);
    return std::make_shared<DeviceScene>(device, scene, options.geometry);
}

frame::Graph make_graph(const stage::Kit& kit, const Options& o) {
    const method::Method& method = method::find_method(o.method);
    frame::Graph graph = method.make(
        kit, {o.lights, o.weier, o.lowres_scale, o.log_polar, o.temporal, o.rings, o.rrm});
    if (o.lens && !o.tangents)
        throw std::invalid_argument("a lens needs the tangents of its display's field of view");
    if (o.lens)
        graph.add(stage::prewarp(kit, stage::make_lens(*o.lens, *o.tangents, o.width, o.height),
                                 method.picture()));
    return graph;
}

// Throws std::invalid_argument for an image that the method does not make, with those that it does.
void check_images(const frame::Graph& graph, const std::vector<std::string>& images) {
    const std::vector<std::string> made = graph.resources();
    const auto makes = [&](std::string_view name) {
        return std::find(made.begin(), made.end(), name) != made.end();
    };
    std::vector<std::string_view> known;
    for (const ImageFormat& format : kFormats)
        if (makes(format.name))
            known.push_back(format.name);
    for (const std::string& image : images)
        if (!makes(image))
            throw std::invalid_argument(fmt::format("method {} has no image \"{}\"; it has {}",
                                                    graph.name(), image, fmt::join(known, ", ")));
}

compute::Buffer zeroed_counters(compute::Device& device) {
    const std::array<std::uint64_t, kernel::kRayClasses.size()> zeros{};
    return device.upload(std::span(zeros), "ray counts");
}

} // namespace

std::span<const ImageFormat> image_formats() {
    return kFormats;
}

std::uint64_t FrameReport::total_rays() const {
    std::uint64_t total = 0;
    for (const std::uint64_t count : rays)
        total += count;
    return total;
}

struct Renderer::State {
    State(std::shared_ptr<DeviceScene> shared_scene, const scene::Scene& scene, const Options& o)
        : on_device(std::move(shared_scene)), device(on_device->device), options(o),
          views(views_of(scene)), ray_totals(zeroed_counters(device)),
          lights(frame::make_lights(
              scene, o.lights, o.light_samples.value_or(frame::default_light_samples(o.lights)))),
          settings(settings_of(scene, o, lights.size())),
          tracer(device, on_device->library, on_device->geometry,
                 stage::choose_variants(device, o.variant)),
          graph(make_graph({device, on_device->library, on_device->geometry, on_device->surfaces,
                            tracer, settings.width, settings.height, lights,
                            settings.ambient_occlusion_samples, has_highlights(scene), ray_totals,
                            o.lanes == 0 ? stage::lanes_for(device) : o.lanes, o.width, o.height,
                            frame::has_optics(scene) ? o.depth : 0, 0,
                            on_device->blended ? o.layers : 0, on_device->blended.get()},
                           o)),
          timings(o.warm_up_frames), begun(on_device->frames()) {
        check_images(graph, o.images);
        std::set<std::string> outputs(o.images.begin(), o.images.end());
        outputs.erase(kFormats.front().name);
        outputs.insert(colour());
        outputs.insert(picture());
        graph.compile(device, outputs);
    }

    // The resource that is delivered as the image "colour".
    const char* colour() const { return method::find_method(options.method).picture(); }
    const char* picture() const { return options.lens ? kLensImage : colour(); }

    std::shared_ptr<DeviceScene> on_device;
    compute::Device device;
    Options options;
    scene::Scene views;
    compute::Buffer ray_totals;
    std::vector<shared::Light> lights;
    frame::FrameSettings settings;
    stage::Tracer tracer;
    frame::Graph graph;
    frame::Timings timings;
    std::optional<shared::Camera> last_camera;
    std::uint64_t begun;     // frames, as DeviceScene counts them
    std::uint32_t frame = 0; // of start()
    std::chrono::steady_clock::time_point start;
    std::array<std::uint64_t, kernel::kRayClasses.size()> last_rays{};
};

Renderer::Renderer(const compute::Device& device, const scene::Scene& scene, const Options& options)
    : Renderer(checked_scene(device, scene, options), scene, options) {}
Renderer::Renderer(std::shared_ptr<DeviceScene> on_device, const scene::Scene& scene,
                   const Options& options)
    : state_(std::make_unique<State>(std::move(on_device), scene, options)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

FrameReport Renderer::render(std::uint32_t frame) {
    return render(frame, frame::camera_on_path(state_->views, frame));
}

FrameReport Renderer::render(std::uint32_t frame, const scene::Camera& view,
                             const frame::Gaze& gaze) {
    start(frame, view, gaze);
    return finish();
}

void Renderer::start(std::uint32_t frame, const scene::Camera& view, const frame::Gaze& gaze) {
    State& s = *state_;
    const frame::Tangents tangents = s.options.tangents.value_or(
        frame::tangents_of(view.vertical_fov_degrees, s.options.width, s.options.height));
    const shared::Camera camera = frame::make_camera(view, tangents);
    const shared::FrameParams params =
        frame::make_params(s.settings, frame, camera, s.last_camera, gaze);
    s.on_device->begin_frame(++s.begun, frame,
                             {view.eye, glm::vec3(params.gaze[0], params.gaze[1], params.gaze[2])});
    s.last_camera = camera;

    s.device.finish();
    s.device.timeline().take();
    s.frame = frame;
    s.start = std::chrono::steady_clock::now();
    s.graph.execute(params);
    s.device.flush();
}

FrameReport Renderer::finish() {
    State& s = *state_;
    s.device.finish();
    const std::chrono::duration<double, std::milli> wall =
        std::chrono::steady_clock::now() - s.start;

    FrameReport report;
    report.frame = s.frame;
    report.wall_ms = wall.count();
    report.stages = frame::sum_by_stage(s.device.timeline().take());
    s.timings.add(report.stages, report.wall_ms);
    const auto totals = s.ray_totals.map_read<std::uint64_t>();
    for (std::size_t i = 0; i < report.rays.size(); ++i) {
        report.rays[i] = totals[i] - s.last_rays[i];
        s.last_rays[i] = totals[i];
    }
    return report;
}

Image Renderer::image(const std::string& resource, const ImageFormat& format,
                      method::Size size) const {
    auto mapping = state_->graph.result(resource).map_read<std::uint32_t>();
    const std::span<const std::uint32_t> words(mapping.data(), mapping.size());
    std::span<const float> floats;
    if (!format.integer)
        floats = {reinterpret_cast<const float*>(words.data()), words.size()};
    return {size.width, size.height, format.components, format.integer,
            floats,     words,       std::move(mapping)};
}

Image Renderer::map(const std::string& name) const {
    const State& s = *state_;
    const bool colour = name == kFormats.front().name, lens = name == kLensImage;
    const method::Size size = colour || lens ? method::Size{s.options.width, s.options.height}
                                             : method::Size{s.settings.width, s.settings.height};
    const std::string resource = colour ? s.colour() : name;
    for (const ImageFormat& format : kFormats) {
        if (format.name == name && s.graph.result(resource))
            return image(resource, format, size);
    }
    throw std::invalid_argument(
        fmt::format("image \"{}\" was not asked for when the renderer was made", name));
}

Image Renderer::picture() const {
    return map(state_->options.lens ? kLensImage : kFormats.front().name);
}

std::string Renderer::hash() const {
    const Image shown = picture();
    return fmt::format("{:016x}", XXH3_64bits(shown.words.data(), shown.words.size_bytes()));
}

void Renderer::set_transforms(std::span<const scene::Transform> world_from_object) {
    state_->on_device->set_transforms(world_from_object);
}

void Renderer::reset() {
    state_->last_camera.reset();
    state_->graph.forget();
    state_->on_device->forget_motion();
}

const Options& Renderer::options() const {
    return state_->options;
}

const frame::Timings& Renderer::timings() const {
    return state_->timings;
}

const frame::GeometryStatistics& Renderer::geometry() const {
    return state_->on_device->geometry.statistics();
}

std::string Renderer::variant(kernel::RayClass ray_class) const {
    return state_->tracer.choice(ray_class).variant->name;
}

bool Renderer::has_history() const {
    return state_->graph.has_history();
}

std::string Renderer::explain() const {
    return state_->graph.explain();
}

} // namespace macula::render
