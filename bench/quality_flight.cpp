#include "bench/quality_flight.hpp"

#include <algorithm>
#include <map>

#include "bench/foveation_scenes.hpp"
#include "bench/wearer.hpp"
#include "host/metric/statistics.hpp"

namespace macula::bench {
namespace {

// Times of the stages over the frames, in the order in which they first came.
class StageTimes {
  public:
    void add(const std::vector<frame::StageTime>& stages) {
        for (const frame::StageTime& stage : stages) {
            Row& row = row_of(stage.stage);
            row.launches = stage.launches;
            row.ms.push_back(stage.device_ms);
        }
    }
    std::vector<report::StageRow> rows() const {
        std::vector<report::StageRow> result;
        for (const Row& row : rows_)
            result.push_back({row.stage,
                              row.launches,
                              {metric::median(row.ms), metric::percentile(row.ms, 0.95),
                               metric::percentile(row.ms, 0.99)}});
        return result;
    }

  private:
    struct Row {
        std::string stage;
        std::uint32_t launches = 0;
        std::vector<double> ms;
    };
    Row& row_of(const std::string& stage) {
        const auto known = std::find_if(rows_.begin(), rows_.end(),
                                        [&](const Row& row) { return row.stage == stage; });
        return known != rows_.end() ? *known : rows_.emplace_back(Row{stage, 0, {}});
    }

    std::vector<Row> rows_;
};

void add(Sequence& sequence, StageTimes& stages, const render::FrameReport& report) {
    double ms = 0.0;
    for (const frame::StageTime& stage : report.stages)
        ms += stage.device_ms;
    sequence.device_ms.push_back(ms);
    sequence.wall_ms.push_back(report.wall_ms);
    sequence.samples += camera_rays(report);
    sequence.rays += static_cast<double>(report.total_rays());
    stages.add(report.stages);
}

} // namespace

bool Sequence::has_device_clock() const {
    return std::all_of(device_ms.begin(), device_ms.end(), [](double ms) { return ms > 0.0; });
}

metric::Picture copy_colour(const render::Renderer& renderer) {
    const render::Image image = renderer.map("colour");
    metric::Picture picture{image.width, image.height, {}};
    picture.rgb.resize(3 * picture.pixels());
    for (std::size_t i = 0; i < picture.pixels(); ++i)
        std::copy_n(&image.floats[i * image.components], 3, &picture.rgb[3 * i]);
    return picture;
}

metric::MotionField copy_motion(const render::Renderer& renderer) {
    const render::Image image = renderer.map("motion");
    return {image.width, image.height, {image.floats.begin(), image.floats.end()}};
}

QualityFlight::QualityFlight(const QualityOptions& options, const compute::Device& device,
                             const std::string& scene)
    : options_(options), name_(scene_name(scene)),
      scene_(load_fly_through(scene, options.scene_path)),
      display_(sized_display(options.display, options.width, options.height)) {
    if (scene_.physics) // all runs see the same spheres, however they look at them
        scene_.physics->acuity.exact_degrees = 180.0f;
    Wearer wearer = wearer_of(options, display_);
    gaze_name_ = wearer.gaze_name;
    head_name_ = wearer.head_name;
    view_ = std::make_unique<FlightView>(scene_, display_, std::move(wearer.gaze),
                                         std::move(wearer.head));
    frame::GeometryOptions geometry;
    geometry.cache_directory = options.bvh_cache;
    on_device_ = std::make_shared<render::DeviceScene>(device, scene_, geometry);
}

render::Renderer QualityFlight::make(frame::LightMode lights,
                                     const std::function<void(render::Options&)>& change) const {
    render::Options engine;
    engine.width = display_.width;
    engine.height = display_.height;
    engine.tangents = tangents_of(display_);
    engine.lights = lights;
    engine.light_samples = options_.light_samples;
    engine.ambient_occlusion_samples = options_.ambient_occlusion_samples;
    engine.seed = options_.seed;
    change(engine);
    return {on_device_, scene_, engine};
}

render::FrameReport QualityFlight::render(render::Renderer& renderer, std::uint32_t frame) const {
    const FlightFrame view = view_->at(frame);
    return renderer.render(frame, view.camera, view.gaze);
}

std::vector<Sequence> QualityFlight::fly(std::span<render::Renderer> renderers) const {
    const Schedule schedule(options_.frames, options_.segments, options_.warm_up,
                            scene_.path.frames);
    std::vector<Sequence> sequences(renderers.size());
    std::vector<StageTimes> stages(renderers.size());
    for (render::Renderer& renderer : renderers)
        render(renderer, schedule.first(0));
    for (std::uint32_t segment = 0; segment < schedule.segments(); ++segment) {
        const std::uint32_t first = schedule.first(segment), end = first + schedule.count(segment);
        for (render::Renderer& renderer : renderers) {
            renderer.reset();
            for (std::uint32_t frame = first - schedule.warm_up(); frame < first; ++frame)
                render(renderer, frame);
        }
        for (std::uint32_t frame = first; frame < end; ++frame) {
            for (std::size_t turn = 0; turn < renderers.size(); ++turn) {
                const std::size_t i = frame % 2 == 0 ? turn : renderers.size() - 1 - turn;
                add(sequences[i], stages[i], render(renderers[i], frame));
                sequences[i].pictures.push_back(copy_colour(renderers[i]));
            }
        }
    }
    for (std::size_t i = 0; i < renderers.size(); ++i) {
        sequences[i].samples /= options_.frames;
        sequences[i].rays /= options_.frames;
        sequences[i].stages = stages[i].rows();
    }
    return sequences;
}

std::vector<QualityFlight::Spot> QualityFlight::spots() const {
    const Schedule schedule(options_.frames, options_.segments, options_.warm_up,
                            scene_.path.frames);
    std::vector<Spot> result;
    for (std::uint32_t segment = 0; segment < schedule.segments(); ++segment) {
        for (std::uint32_t i = 0; i < schedule.count(segment); ++i)
            result.push_back({schedule.first(segment) + i, i == 0});
    }
    return result;
}

report::QualityCase QualityFlight::blank() const {
    report::QualityCase blank;
    blank.scene = name_;
    blank.width = display_.width;
    blank.height = display_.height;
    blank.frames = options_.frames;
    blank.segments = options_.segments;
    blank.warm_up = options_.warm_up;
    blank.reference_spp = options_.reference_spp;
    blank.seed = options_.seed;
    blank.ambient_occlusion_samples = options_.ambient_occlusion_samples;
    blank.display = display_.name;
    blank.gaze = gaze_name_;
    blank.head = head_name_;
    const scene::EyeView& eye = display_.eye(scene::Eye::mono);
    blank.view = {eye.tan_left, eye.tan_right, eye.tan_up, eye.tan_down};
    double x = 0.0, y = 0.0; // on the view axis, as `macula compare --display` takes it
    scene::project(display_, scene::Eye::mono, glm::dvec3(0.0, 0.0, -1.0), x, y);
    blank.pixels_per_degree = scene::pixels_per_degree(display_, scene::Eye::mono, x, y);
    blank.device = on_device_->device.facts().name;
    blank.driver = on_device_->device.facts().driver_version;
    blank.commit = MACULA_COMMIT;
    return blank;
}

} // namespace macula::bench
