// The naive baseline: fewer pixels everywhere, enlarged.
#include "host/stage/lowres.hpp"
#include "host/method/method.hpp"
#include "host/stage/ambient_occlusion.hpp"
#include "host/stage/light.hpp"
#include "host/stage/primary.hpp"
#include "host/stage/shade.hpp"
#include "host/stage/surface.hpp"

namespace macula::method {

frame::Graph make_lowres(const stage::Kit& kit, const Options& options) {
    const bool occlusion = options.lights == frame::LightMode::ambient_occlusion;
    const stage::Coarse size = stage::coarse_size(kit, options.lowres_scale);
    frame::Graph graph("lowres", "uniform lower resolution, enlarged by a bicubic filter");
    std::vector<frame::Stage> stages = {
        stage::grid_rays(kit, size),
        stage::trace_primary_rays(kit),
        stage::resolve_surface(kit),
        occlusion ? stage::ambient_occlusion(kit) : stage::direct_light(kit, {size.width}),
        stage::shade(kit, !occlusion, occlusion),
    };
    const std::string colour = add_secondary_rays(stages, kit, options, {}, {size.width});
    stages.push_back(stage::average_samples(kit, colour, "sampled colour"));
    graph.for_each_sample(std::move(stages));
    graph.add(stage::enlarge(kit, size));
    return graph;
}

} // namespace macula::method
