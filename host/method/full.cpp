// Every pixel, any samples per pixel: what the other methods are measured against.
#include "host/method/method.hpp"
#include "host/stage/ambient_occlusion.hpp"
#include "host/stage/light.hpp"
#include "host/stage/primary.hpp"
#include "host/stage/shade.hpp"
#include "host/stage/surface.hpp"
#include "host/stage/temporal.hpp"

namespace macula::method {

frame::Graph make_full(const stage::Kit& kit, const Options& options) {
    const bool occlusion = options.lights == frame::LightMode::ambient_occlusion;
    frame::Graph graph("full", "every pixel, any samples per pixel");
    std::vector<frame::Stage> stages = {
        stage::primary_rays(kit),
        stage::trace_primary_rays(kit),
        stage::resolve_surface(kit),
        stage::place_surfaces(kit),
        occlusion ? stage::ambient_occlusion(kit) : stage::direct_light(kit),
        stage::shade(kit, !occlusion, occlusion),
    };
    const std::string colour = add_secondary_rays(stages, kit, options);
    stages.push_back(stage::average_samples(kit, colour, "colour"));
    for (frame::Stage& image : surface_images(kit, options))
        stages.push_back(std::move(image));
    graph.for_each_sample(std::move(stages));
    return graph;
}

} // namespace macula::method
