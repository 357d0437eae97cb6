// Log-rectilinear foveation (Li et al. 2021, "A Log-Rectilinear Transformation for Foveated
// 360-Degree Video Streaming"); docs/methods/logrect.md says what that means for a ray tracer.
#include "host/method/method.hpp"
#include "host/stage/ambient_occlusion.hpp"
#include "host/stage/light.hpp"
#include "host/stage/log_polar.hpp"
#include "host/stage/primary.hpp"
#include "host/stage/shade.hpp"
#include "host/stage/surface.hpp"
#include "host/stage/temporal.hpp"

namespace macula::method {

frame::Graph make_logrect(const stage::Kit& kit, const Options& options) {
    const bool occlusion = options.lights == frame::LightMode::ambient_occlusion;
    stage::LogPolarOptions shape = options.log_polar;
    shape.alpha = shape.rect_alpha;
    const stage::LogPolarKit log_rect{
        kit,
        std::make_shared<stage::LogPolarBuffer>(stage::make_params(
            shape, kit.width, kit.height, kit.picture_width(), kit.picture_height())),
        true};
    frame::Graph graph("logrect", "samples uniform in log-rectilinear space (Li et al. 2021)");
    graph.add(stage::place_fovea(log_rect)).add(stage::choose_samples(log_rect));
    const stage::PlaceRows rows{kit.width, log_rect.buffer->params().pitch};
    std::vector<frame::Stage> stages = {
        stage::log_polar_rays(log_rect),
        stage::trace_primary_rays(kit, kernel::RayClass::sparse),
        stage::resolve_surface(kit, "spread of slot"),
        stage::place_surfaces(log_rect),
        occlusion ? stage::ambient_occlusion(kit) : stage::direct_light(kit, rows),
        stage::shade(kit, !occlusion, occlusion),
    };
    const std::string colour = add_secondary_rays(stages, kit, options, "spread of slot", rows);
    stages.push_back(stage::average_listed(kit, colour, "sampled colour", 16));
    graph.for_each_sample(std::move(stages));
    graph.add(stage::remap_log_polar(log_rect)).add(stage::remap_surfaces(log_rect));
    return graph;
}

} // namespace macula::method
