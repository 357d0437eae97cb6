#include "host/stage/surface.hpp"

namespace macula::stage {

frame::Stage resolve_surface(const Kit& kit, const std::string& spreads) {
    frame::Stage stage;
    stage.name = kit.named("resolve surfaces");
    stage.reads = {kit.rays(), kit.named("ray count"), kit.named("hits")};
    if (!spreads.empty())
        stage.reads.push_back(spreads);
    if (!kit.primary())
        stage.reads.insert(stage.reads.end(), {kit.named("throughput"), kit.named("origin")});
    stage.writes = {
        of_level(kit, "surface depth", 4),
        of_level(kit, "surface position", 16),
        of_level(kit, "surface geometric normal", 16),
        of_level(kit, "surface shading normal", 16),
        of_level(kit, "surface albedo", 16),
        of_level(kit, "surface specular", 16),
        of_level(kit, "surface emission", 16),
        of_level(kit, "surface triangle", 4),
        of_level(kit, "surface material", 4),
        of_level(kit, "surface motion", 8),
    };
    stage.prepare = [kit, spreads, name = stage.name] {
        auto kernel = kit.lane_kernel("shade/surface", "resolve_surface");
        return [kit, spreads, name, kernel](frame::Run& run) mutable {
            const compute::Buffer none;
            const auto of = [&](const char* what) { return run[kit.named(what)]; };
            // Any layout's instance table will do: its roots are not read here.
            const auto layout = kit.tracer.choice(kernel::RayClass::primary).variant->layout;
            const frame::DeviceSurfaces& scene = kit.surfaces;
            kernel
                .set(run.params_buffer(), run[kit.rays()], run[kit.named("ray count")],
                     run[kit.named("hits")], kit.geometry.layout(layout).instances,
                     static_cast<std::uint32_t>(kit.geometry.instances().size()), scene.triangles,
                     scene.vertices, scene.materials, scene.textures, scene.levels, scene.texels,
                     scene.decode, spreads.empty() ? none : run[spreads], of("throughput"),
                     of("origin"), of("surface depth"), of("surface position"),
                     of("surface geometric normal"), of("surface shading normal"),
                     of("surface albedo"), of("surface specular"), of("surface emission"),
                     of("surface triangle"), of("surface material"), of("surface motion"))
                .launch(name, kit.lane_items(kit.launched()), kit.lane_group());
        };
    };
    return stage;
}

} // namespace macula::stage
