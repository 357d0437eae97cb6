#include "host/method/method.hpp"
#include "host/stage/shade.hpp"

namespace macula::method {

std::vector<frame::Stage> surface_images(const stage::Kit& kit, const Options& options) {
    std::vector<frame::Stage> stages = {
        stage::average_samples(kit, "surface albedo", "albedo"),
        stage::keep_first_sample(kit, "surface depth", "depth", 4),
        stage::keep_first_sample(kit, "surface position", "position", 16),
        stage::keep_first_sample(kit, "surface geometric normal", "geometric normal", 16),
        stage::keep_first_sample(kit, "surface shading normal", "shading normal", 16),
        stage::keep_first_sample(kit, "surface triangle", "triangle", 4),
        stage::keep_first_sample(kit, "surface material", "material", 4),
        stage::keep_first_sample(kit, "surface motion", "motion", 8),
    };
    if (options.lights == frame::LightMode::ambient_occlusion)
        stages.push_back(
            stage::average_scalar_samples(kit, "surface openness", "ambient occlusion"));
    else
        stages.push_back(stage::average_samples(kit, "surface irradiance", "irradiance"));
    return stages;
}

} // namespace macula::method
