#include "host/stage/shade.hpp"

namespace macula::stage {
namespace {

frame::Stage average(const Kit& kit, const std::string& from, const std::string& image,
                     std::uint32_t element_bytes, const char* entry) {
    frame::Stage stage;
    stage.name = "average " + image;
    stage.reads = {"ray count", "pixel of slot", from};
    stage.writes = {per_pixel(kit, image, element_bytes)};
    stage.prepare = [kit, from, image, entry, name = stage.name] {
        auto kernel = kit.library.kernel(kernel::VariantKey("shade/resolve"), entry, kit.device);
        return [kit, from, image, name, kernel](frame::Run& run) mutable {
            kernel
                .set(run.params_buffer(), run.sample(), run["ray count"], run["pixel of slot"],
                     run[from], run[image])
                .launch(name, {kit.launched()}, {kGroup});
        };
    };
    return stage;
}

} // namespace

frame::Stage shade(const Kit& kit, bool direct_light, bool ambient_occlusion,
                   const std::string& irradiance, const std::string& openness) {
    const bool highlights = direct_light && kit.highlights, optics = kit.depth > 0;
    frame::Stage stage;
    stage.name = kit.named("shade");
    for (const char* read : {"ray count", "surface albedo", "surface emission"})
        stage.reads.push_back(kit.named(read));
    if (direct_light)
        stage.reads.push_back(irradiance);
    if (highlights)
        stage.reads.insert(stage.reads.end(),
                           {kit.named("surface specular"), kit.named("surface highlight")});
    if (ambient_occlusion)
        stage.reads.push_back(openness);
    if (optics)
        stage.reads.push_back(kit.named("surface material"));
    stage.writes = {of_level(kit, "surface colour", 16)};
    stage.prepare = [=, name = stage.name] {
        auto kernel =
            kit.library.kernel(kernel::VariantKey("shade/shade"), "shade_samples", kit.device);
        return [=](frame::Run& run) mutable {
            const auto of = [&](const char* what, bool wanted = true) {
                return wanted ? run[kit.named(what)] : compute::Buffer();
            };
            const compute::Buffer none;
            kernel
                .set(run.params_buffer(), of("ray count"), of("surface albedo"),
                     of("surface specular", highlights), of("surface emission"),
                     direct_light ? run[irradiance] : none, of("surface highlight", highlights),
                     ambient_occlusion ? run[openness] : none, of("surface material", optics),
                     optics ? kit.surfaces.optics : none, of("surface colour"))
                .launch(name, {kit.launched()}, {kGroup});
        };
    };
    return stage;
}

frame::Stage average_samples(const Kit& kit, const std::string& from, const std::string& image) {
    return average(kit, from, image, 16, "average_samples");
}

frame::Stage average_scalar_samples(const Kit& kit, const std::string& from,
                                    const std::string& image) {
    return average(kit, from, image, 4, "average_scalar_samples");
}

frame::Stage average_listed(const Kit& kit, const std::string& from, const std::string& mean,
                            std::uint32_t element_bytes) {
    frame::Stage stage;
    stage.name = "average " + mean;
    stage.reads = {"ray count", from};
    stage.writes = {per_slot(kit, mean, element_bytes)};
    stage.prepare = [kit, from, mean, element_bytes, name = stage.name] {
        auto kernel =
            kit.library.kernel(kernel::VariantKey("shade/resolve"), "average_listed", kit.device);
        return [kit, from, mean, element_bytes, name, kernel](frame::Run& run) mutable {
            kernel
                .set(run.params_buffer(), run.sample(), element_bytes / 4, run["ray count"],
                     run[from], run[mean])
                .launch(name, {kit.launched()}, {kGroup});
        };
    };
    return stage;
}

frame::Stage keep_first_sample(const Kit& kit, const std::string& from, const std::string& image,
                               std::uint32_t element_bytes) {
    frame::Stage stage;
    stage.name = "keep the first " + image;
    stage.reads = {"ray count", "pixel of slot", from};
    stage.writes = {per_pixel(kit, image, element_bytes)};
    stage.prepare = [kit, from, image, element_bytes, name = stage.name] {
        auto kernel = kit.library.kernel(kernel::VariantKey("shade/resolve"), "keep_first_sample",
                                         kit.device);
        return [kit, from, image, element_bytes, name, kernel](frame::Run& run) mutable {
            if (run.sample() != 0)
                return;
            kernel
                .set(element_bytes / 4, run["ray count"], run["pixel of slot"], run[from],
                     run[image])
                .launch(name, {kit.launched()}, {kGroup});
        };
    };
    return stage;
}

} // namespace macula::stage
