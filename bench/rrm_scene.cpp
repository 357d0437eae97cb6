#include "bench/rrm_scene.hpp"

#include "bench/flight.hpp"
#include "bench/foveation_scenes.hpp"
#include "bench/series.hpp"

namespace macula::bench {
namespace {

std::array<float, 3> edges(float fovea, float a) {
    return {fovea, fovea * (1.0f + a), fovea * (1.0f + 3.0f * a)};
}

} // namespace

RrmScene::RrmScene(const RrmOptions& options, const compute::Device& device,
                   const std::string& name)
    : options_(options), scene_(load_fly_through(name, options.scene_path)),
      display_(sized_display(options.display, options.width, options.height)) {
    frame::GeometryOptions geometry;
    geometry.cache_directory = options.bvh_cache;
    on_device_ = std::make_shared<render::DeviceScene>(device, scene_, geometry);
}

render::Renderer RrmScene::make(const RrmMethod& method, std::uint32_t depth,
                                std::vector<std::string> images) const {
    render::Options engine;
    engine.width = display_.width;
    engine.height = display_.height;
    engine.tangents = tangents_of(display_);
    engine.method = method.name;
    engine.depth = depth;
    engine.seed = options_.seed;
    engine.images = std::move(images);
    engine.rrm.fovea = options_.fovea;
    if (method.name == "rrm")
        stage::set_group(engine.rrm, method.n);
    if (method.name == "lowres_rings")
        engine.rings.edges = method.ring_edges;
    return {on_device_, scene_, engine};
}

scene::Camera RrmScene::camera() const {
    return frame::camera_on_path(scene_, 0);
}

std::vector<frame::Gaze> RrmScene::gazes() const {
    const shared::Camera c = frame::make_camera(camera(), tangents_of(display_));
    std::vector<frame::Gaze> gazes;
    for (std::uint32_t row = 0; row < options_.rows; ++row)
        for (std::uint32_t column = 0; column < options_.columns; ++column) {
            const float x = (static_cast<float>(column) + 0.5f) / options_.columns;
            const float y = (static_cast<float>(row) + 0.5f) / options_.rows;
            const float right = x * (c.tan_left + c.tan_right) - c.tan_left;
            const float up = c.tan_up - y * (c.tan_up + c.tan_down);
            glm::vec3 direction;
            for (int i = 0; i < 3; ++i)
                direction[i] = c.right[i] * right + c.up[i] * up + c.forward[i];
            gazes.push_back({direction, 1.0f});
        }
    return gazes;
}

std::vector<shared::FrameParams> RrmScene::frames() const {
    frame::FrameSettings settings;
    settings.width = display_.width;
    settings.height = display_.height;
    const shared::Camera camera = frame::make_camera(this->camera(), tangents_of(display_));
    std::vector<shared::FrameParams> frames;
    for (const frame::Gaze& gaze : gazes())
        frames.push_back(frame::make_params(settings, 0, camera, {}, gaze));
    return frames;
}

std::array<float, 3> RrmScene::ring_edges(std::uint32_t n) const {
    const std::vector<shared::FrameParams> all = frames();
    double wanted = 0.0;
    for (const shared::FrameParams& frame : all) {
        const auto fovea = stage::foveal_rectangle(frame, options_.fovea, 2);
        const double inside =
            fovea.empty() ? 0.0 : double{1} * (fovea.x1 - fovea.x0) * (fovea.y1 - fovea.y0);
        wanted += inside + (double{1} * frame.width * frame.height - inside) / n;
    }
    const auto samples = [&](float a) {
        double sum = 0.0;
        for (const shared::FrameParams& frame : all)
            sum += static_cast<double>(
                stage::count_blocks(frame, stage::make_params({edges(options_.fovea, a)})));
        return sum;
    };
    float low = 0.0f, high = (180.0f / std::max(options_.fovea, 1.0f) - 1.0f) / 3.0f;
    for (int step = 0; step < 20; ++step) {
        const float middle = 0.5f * (low + high);
        (samples(middle) < wanted ? low : high) = middle;
    }
    return edges(options_.fovea, low);
}

} // namespace macula::bench
