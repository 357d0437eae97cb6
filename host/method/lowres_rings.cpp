// The multi-resolution renderer that Smith et al. 2014 began with and measured refresh rate
// modulation against (section 3.2.1, figure 8); docs/methods/lowres_rings.md says what differs.
#include "host/method/method.hpp"
#include "host/stage/ambient_occlusion.hpp"
#include "host/stage/light.hpp"
#include "host/stage/primary.hpp"
#include "host/stage/rings.hpp"
#include "host/stage/shade.hpp"
#include "host/stage/surface.hpp"

namespace macula::method {

frame::Graph make_lowres_rings(const stage::Kit& all, const Options& options) {
    const bool occlusion = options.lights == frame::LightMode::ambient_occlusion;
    const stage::RingKit rings(all, options.rings);
    const stage::Kit& kit = rings.kit;
    frame::Graph graph("lowres_rings",
                       "blocks of pixels that grow in rings around the gaze, blurred");
    graph.add(stage::place_rings(rings)).add(stage::choose_blocks(rings));
    std::vector<frame::Stage> stages = {
        stage::block_rays(rings),
        stage::trace_primary_rays(kit, kernel::RayClass::sparse),
        stage::resolve_surface(kit, "spread of slot"),
        occlusion ? stage::ambient_occlusion(kit) : stage::direct_light(kit),
        stage::shade(kit, !occlusion, occlusion),
    };
    const std::string colour = add_secondary_rays(stages, kit, options, "spread of slot");
    stages.push_back(stage::average_samples(kit, colour, "block colour"));
    graph.for_each_sample(std::move(stages));
    graph.add(stage::show_rings(rings));
    return graph;
}

} // namespace macula::method
