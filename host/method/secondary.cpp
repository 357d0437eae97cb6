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

// The name of the colour with the layers before the hits of the kit's rays.
std::string blend_layers(std::vector<frame::Stage>& stages, const stage::Kit& kit,
                         const std::string& spreads, bool occlusion, stage::PlaceRows rows,
                         const std::string& colour) {
    if (kit.layers == 0)
        return colour;
    stages.push_back(stage::collect_layers(kit, spreads));
    shade_list(stages, kit.at_layers(), occlusion, rows);
    stages.push_back(stage::add_layers(kit, colour));
    return stages.back().writes.front().name;
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
        colour = blend_layers(stages, next, {}, occlusion, rows, colour);
        shade_list(stages, next, occlusion, rows);
        stages.push_back(stage::add_secondary_light(next, colour));
        colour = stages.back().writes.front().name;
    }
    return blend_layers(stages, kit, spreads, occlusion, rows, colour);
}

} // namespace macula::method
