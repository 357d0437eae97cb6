// Foveated ray tracing with a reprojection cache (Weier et al. 2016, "Foveated Real-Time Ray
// Tracing for Head-Mounted Displays"); docs/methods/weier.md says what differs and why.
#include "host/method/method.hpp"
#include "host/stage/ambient_occlusion.hpp"
#include "host/stage/cache.hpp"
#include "host/stage/foveated_rays.hpp"
#include "host/stage/light.hpp"
#include "host/stage/primary.hpp"
#include "host/stage/reprojection.hpp"
#include "host/stage/shade.hpp"
#include "host/stage/surface.hpp"

namespace macula::method {

frame::Graph make_weier(const stage::Kit& kit, const Options& options) {
    const bool occlusion = options.lights == frame::LightMode::ambient_occlusion;
    const stage::FoveatedKit foveated{kit, std::make_shared<stage::SupportGrid>(stage::make_params(
                                               options.weier, kit.width, kit.height))};
    frame::Graph graph("weier", "foveated samples and a reprojected cache (Weier et al. 2016)");
    // Figure 2, block 1: reproject, detect errors, generate rays.
    graph.add(stage::project_mesh(foveated))
        .add(stage::draw_mesh(foveated))
        .add(stage::judge_history(foveated))
        .add(stage::choose_pixels(foveated));
    // Block 2: ray tracing.
    graph.for_each_sample({
        stage::listed_rays(foveated),
        stage::trace_primary_rays(kit, kernel::RayClass::sparse),
        stage::resolve_surface(kit),
        occlusion ? stage::ambient_occlusion(kit) : stage::direct_light(kit),
        stage::shade(kit, !occlusion, occlusion),
        stage::average_samples(kit, "surface colour", "sampled colour"),
        stage::keep_first_sample(kit, "surface depth", "sampled depth", 4),
    });
    // Block 3: update and merge the cache.
    graph.add(stage::extract_support(foveated)).add(stage::merge_cache(foveated, 0));
    return graph;
}

} // namespace macula::method
