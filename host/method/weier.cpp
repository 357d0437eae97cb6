// Foveated ray tracing with a reprojection cache (Weier et al. 2016, "Foveated Real-Time Ray
// Tracing for Head-Mounted Displays"); docs/methods/weier.md says what differs and why.
#include "host/method/method.hpp"
#include "host/stage/ambient_occlusion.hpp"
#include "host/stage/cache.hpp"
#include "host/stage/filter_light.hpp"
#include "host/stage/foveated_rays.hpp"
#include "host/stage/light.hpp"
#include "host/stage/primary.hpp"
#include "host/stage/reprojection.hpp"
#include "host/stage/shade.hpp"
#include "host/stage/show.hpp"
#include "host/stage/surface.hpp"

namespace macula::method {
namespace {

// The part of the light buffer that a light mode fills: noisy, hence cached and filtered. Point
// lights have no noise.
struct Light {
    bool occlusion, noisy, filtered;
    std::uint32_t bytes;      // of a value; 0: nothing is cached
    std::string fresh, image; // a slot's value, and the light buffer's name as an image

    Light(frame::LightMode mode, bool post)
        : occlusion(mode == frame::LightMode::ambient_occlusion),
          noisy(mode != frame::LightMode::point), filtered(post && noisy),
          bytes(!filtered ? 0 : (occlusion ? 4 : 16)),
          fresh(occlusion ? "surface openness" : "surface irradiance"),
          image(occlusion ? "ambient occlusion" : "irradiance") {}

    // Ambient occlusion has it everywhere, other light at the edges of shadows: to take that for a
    // change costs a few samples, to miss a change leaves a trail.
    std::uint32_t noise() const { return !noisy ? 0 : (occlusion ? 4 : 2); }

    const std::string& shaded() const {
        static const std::string after = "filtered light";
        return filtered ? after : fresh;
    }
};

} // namespace

frame::Graph make_weier(const stage::Kit& kit, const Options& options) {
    const Light light(options.lights, options.weier.post);
    const bool occlusion = light.occlusion;
    const stage::FoveatedKit foveated{
        kit,
        std::make_shared<stage::SupportGrid>(
            stage::make_params(options.weier, kit.width, kit.height)),
        options.weier.overlay ? "image" : "colour",
        kit.geometry.instanced() ? std::make_shared<stage::InstanceMotions>() : nullptr};
    frame::Graph graph("weier", "foveated samples and a reprojected cache (Weier et al. 2016)");

    // Figure 2, block 1: reprojection and ray generation.
    graph.add(stage::project_mesh(foveated))
        .add(stage::draw_mesh(foveated))
        .add(stage::judge_history(foveated))
        .add(stage::choose_pixels(foveated));

    // Block 2: ray tracing, and block 4, the post-processor, on the samples' light.
    std::vector<frame::Stage> sampling = {
        stage::listed_rays(foveated),
        stage::trace_primary_rays(kit, kernel::RayClass::sparse),
        stage::resolve_surface(kit),
        occlusion ? stage::ambient_occlusion(kit) : stage::direct_light(kit),
    };
    if (light.filtered)
        sampling.push_back(stage::filter_light(foveated, light.fresh, light.image, light.bytes));
    sampling.push_back(stage::shade(kit, !occlusion, occlusion, light.shaded(), light.shaded()));
    const std::string colour = add_secondary_rays(sampling, kit, options);
    sampling.push_back(stage::average_listed(kit, colour, "sampled colour", 16));
    if (light.filtered)
        sampling.push_back(
            stage::average_listed(kit, light.shaded(), "sampled light", light.bytes));
    graph.for_each_sample(std::move(sampling));

    // Block 3: cache update and merge.
    // Ambient occlusion does not depend on the view: what lags there is noise.
    const bool catch_up = options.weier.catch_up && !occlusion;
    graph.add(stage::extract_support(foveated));
    if (catch_up)
        graph.add(stage::measure_lag(foveated));
    if (foveated.can_move())
        graph.add(stage::find_change(foveated, light.noise()));
    graph.add(stage::merge_cache(foveated, catch_up, light.image, light.bytes))
        .add(stage::show_intermediates(foveated))
        .add(stage::place_surfaces(foveated));
    if (options.weier.overlay)
        graph.add(stage::draw_overlay(foveated));
    return graph;
}

} // namespace macula::method
