// Kernel log-polar foveation (Mrad 2022, "Image Upscaling for Ray Traced Foveated Rendering");
// docs/methods/logpolar.md says what differs and why.
#include "host/method/method.hpp"
#include "host/stage/ambient_occlusion.hpp"
#include "host/stage/light.hpp"
#include "host/stage/log_polar.hpp"
#include "host/stage/primary.hpp"
#include "host/stage/shade.hpp"
#include "host/stage/surface.hpp"
#include "host/stage/temporal.hpp"

namespace macula::method {

frame::Graph make_logpolar(const stage::Kit& kit, const Options& options) {
    const bool occlusion = options.lights == frame::LightMode::ambient_occlusion;
    const stage::LogPolarKit log_polar{
        kit,
        std::make_shared<stage::LogPolarBuffer>(stage::make_params(
            options.log_polar, kit.width, kit.height, kit.picture_width(), kit.picture_height()))};
    frame::Graph graph("logpolar", "samples uniform in kernel log-polar space (Mrad 2022)");
    graph.add(stage::place_fovea(log_polar)).add(stage::choose_samples(log_polar));
    const stage::PlaceRows rows{kit.width, log_polar.buffer->params().pitch};
    std::vector<frame::Stage> stages = {
        stage::log_polar_rays(log_polar),
        stage::trace_primary_rays(kit, kernel::RayClass::sparse),
        stage::resolve_surface(kit, "spread of slot"),
        stage::place_surfaces(log_polar),
        occlusion ? stage::ambient_occlusion(kit) : stage::direct_light(kit, rows),
        stage::shade(kit, !occlusion, occlusion),
    };
    const std::string colour = add_secondary_rays(stages, kit, options, "spread of slot", rows);
    stages.push_back(stage::average_listed(kit, colour, "sampled colour", 16));
    graph.for_each_sample(std::move(stages));
    graph.add(stage::remap_log_polar(log_polar)).add(stage::remap_surfaces(log_polar));
    return graph;
}

} // namespace macula::method
