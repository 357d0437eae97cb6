#include "host/stage/secondary.hpp"
#include "host/method/method.hpp"
#include "host/stage/ambient_occlusion.hpp"
#include "host/stage/shade.hpp"
#include "host/stage/surface.hpp"

namespace macula::method {

std::string add_secondary_rays(std::vector<frame::Stage>& stages, const stage::Kit& kit,
                               const Options& options, const std::string& spreads,
                               stage::PlaceRows rows) {
    const bool occlusion = options.lights == frame::LightMode::ambient_occlusion;
    std::string colour = kit.named("surface colour");
    for (std::uint32_t level = 1; level <= kit.depth; ++level) {
        const stage::Kit next = kit.at_level(level);
        stages.push_back(stage::secondary_rays(next, spreads));
        stages.push_back(stage::trace_secondary_rays(next));
        stages.push_back(stage::resolve_surface(next));
        stages.push_back(occlusion ? stage::ambient_occlusion(next)
                                   : stage::direct_light(next, rows));
        stages.push_back(stage::shade(next, !occlusion, occlusion, next.named("surface irradiance"),
                                      next.named("surface openness")));
        stages.push_back(stage::add_secondary_light(next, colour));
        colour = stages.back().writes.front().name;
    }
    return colour;
}

} // namespace macula::method
