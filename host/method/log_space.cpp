// What the methods share that sample uniformly in a space around the gaze (Mrad 2022, figure 4.1).
#include "host/method/method.hpp"
#include "host/stage/ambient_occlusion.hpp"
#include "host/stage/light.hpp"
#include "host/stage/log_polar.hpp"
#include "host/stage/primary.hpp"
#include "host/stage/shade.hpp"
#include "host/stage/surface.hpp"
#include "host/stage/temporal.hpp"

namespace macula::method {

frame::Graph make_log_space(frame::Graph graph, const stage::Kit& kit, const Options& options,
                            const stage::LogPolarOptions& shape, bool rectangular) {
    const bool occlusion = options.lights == frame::LightMode::ambient_occlusion;
    const stage::LogPolarKit space{
        kit,
        std::make_shared<stage::LogPolarBuffer>(stage::make_params(
            shape, kit.width, kit.height, kit.picture_width(), kit.picture_height())),
        rectangular, options.smoothed};
    graph.add(stage::place_fovea(space)).add(stage::choose_samples(space));
    const stage::PlaceRows rows{kit.width, space.buffer->params().pitch};
    std::vector<frame::Stage> stages = {
        stage::log_polar_rays(space),
        stage::trace_primary_rays(kit, kernel::RayClass::sparse),
        stage::resolve_surface(kit, "spread of slot"),
        stage::place_surfaces(space),
        occlusion ? stage::ambient_occlusion(kit) : stage::direct_light(kit, rows),
        stage::shade(kit, !occlusion, occlusion),
    };
    const std::string colour = add_secondary_rays(stages, kit, options, "spread of slot", rows);
    stages.push_back(stage::average_listed(kit, colour, "sampled colour", 16));
    graph.for_each_sample(std::move(stages));
    graph.add(stage::remap_log_polar(space)).add(stage::remap_surfaces(space));
    return graph;
}

} // namespace macula::method
