// Refresh rate modulation (Smith, Booth and Bailey 2014, "Refresh Rate Modulation for Perceptually
// Optimized Computer Graphics"); docs/methods/rrm.md says what differs and why.
#include "host/stage/rrm.hpp"
#include "host/method/method.hpp"
#include "host/stage/ambient_occlusion.hpp"
#include "host/stage/light.hpp"
#include "host/stage/primary.hpp"
#include "host/stage/shade.hpp"
#include "host/stage/surface.hpp"

namespace macula::method {

frame::Graph make_rrm(const stage::Kit& all, const Options& options) {
    const bool occlusion = options.lights == frame::LightMode::ambient_occlusion;
    stage::Kit kit = all;
    const auto cycle = std::make_shared<stage::RefreshCycle>(options.rrm, kit.width, kit.height);
    kit.used_slots = cycle->used_slots();
    const stage::RrmKit refresh{kit, cycle};
    frame::Graph graph("rrm", "the fovea in every frame, the rest in turns (Smith et al. 2014)");
    graph.add(stage::plan_refresh(refresh));
    std::vector<frame::Stage> stages = {
        stage::refreshed_rays(refresh),
        stage::trace_primary_rays(kit, kernel::RayClass::sparse),
        stage::resolve_surface(kit),
        occlusion ? stage::ambient_occlusion(kit) : stage::direct_light(kit),
        stage::shade(kit, !occlusion, occlusion),
    };
    const std::string colour = add_secondary_rays(stages, kit, options);
    stages.push_back(stage::keep_refreshed(refresh, colour));
    stages.push_back(stage::note_refresh(refresh));
    for (frame::Stage& image : surface_images(kit, options))
        stages.push_back(stage::persistent(std::move(image)));
    graph.for_each_sample(std::move(stages), options.rrm.foveal_samples);
    graph.add(stage::show_age(refresh));
    return graph;
}

} // namespace macula::method
