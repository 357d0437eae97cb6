#include "host/stage/secondary.hpp"
#include "host/method/method.hpp"
#include "host/stage/ambient_occlusion.hpp"
#include "host/stage/layers.hpp"
#include "host/stage/shade.hpp"
#include "host/stage/surface.hpp"

namespace macula::method {
namespace {

// From the hits of a list to its "surface colour".
void shade_list(std::vector<frame::Stage>& stages, const stage::Kit& list, bool occlusion,
                stage::PlaceRows rows) {
    stages.push_back(stage::resolve_surface(list));
    stages.push_back(occlusion ? stage::ambient_occlusion(list) : stage::direct_light(list, rows));
    stages.push_back(stage::shade(list, !occlusion, occlusion, list.named("surface irradiance"),
                                  list.named("surface openness")));
}

} // namespace

std::string add_secondary_rays(std::vector<frame::Stage>& stages, const stage::Kit& kit,
                               const Options& options, const std::string& spreads,
                               stage::PlaceRows rows) {
    const bool occlusion = options.lights == frame::LightMode::ambient_occlusion;
    std::string colour = kit.named("surface colour");
    for (std::uint32_t level = 1; level <= kit.depth; ++level) {
        const stage::Kit next = kit.at_level(level);
        stages.push_back(stage::secondary_rays(next, spreads));
        stages.push_back(stage::trace_secondary_rays(next));
        shade_list(stages, next, occlusion, rows);
        stages.push_back(stage::add_secondary_light(next, colour));
        colour = stages.back().writes.front().name;
    }
    if (kit.layers == 0)
        return colour;
    const stage::Kit layers = kit.at_layers();
    stages.push_back(stage::collect_layers(kit, spreads));
    shade_list(stages, layers, occlusion, rows);
    stages.push_back(stage::add_layers(kit, colour));
    return stages.back().writes.front().name;
}

} // namespace macula::method
