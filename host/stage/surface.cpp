#include "host/stage/surface.hpp"

namespace macula::stage {

frame::Stage resolve_surface(const Kit& kit, const std::string& spreads) {
    frame::Stage stage;
    stage.name = "resolve surfaces";
    stage.reads = {"primary rays", "ray count", "hits"};
    if (!spreads.empty())
        stage.reads.push_back(spreads);
    stage.writes = {
        per_slot(kit, "surface depth", 4),
        per_slot(kit, "surface position", 16),
        per_slot(kit, "surface geometric normal", 16),
        per_slot(kit, "surface shading normal", 16),
        per_slot(kit, "surface albedo", 16),
        per_slot(kit, "surface specular", 16),
        per_slot(kit, "surface emission", 16),
        per_slot(kit, "surface triangle", 4),
        per_slot(kit, "surface material", 4),
        per_slot(kit, "surface motion", 8),
    };
    stage.prepare = [kit, spreads, name = stage.name] {
        auto kernel = kit.lane_kernel("shade/surface", "resolve_surface");
        return [kit, spreads, name, kernel](frame::Run& run) mutable {
            const compute::Buffer none;
            // Any layout's instance table will do: its roots are not read here.
            const auto layout = kit.tracer.choice(kernel::RayClass::primary).variant->layout;
            const frame::DeviceSurfaces& scene = kit.surfaces;
            kernel
                .set(run.params_buffer(), run["primary rays"], run["ray count"], run["hits"],
                     kit.geometry.layout(layout).instances,
                     static_cast<std::uint32_t>(kit.geometry.instances().size()), scene.triangles,
                     scene.vertices, scene.materials, scene.textures, scene.levels, scene.texels,
                     scene.decode, spreads.empty() ? none : run[spreads], run["surface depth"],
                     run["surface position"], run["surface geometric normal"],
                     run["surface shading normal"], run["surface albedo"], run["surface specular"],
                     run["surface emission"], run["surface triangle"], run["surface material"],
                     run["surface motion"])
                .launch(name, kit.lane_items(kit.slots()), kit.lane_group());
        };
    };
    return stage;
}

} // namespace macula::stage
