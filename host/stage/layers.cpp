#include "host/stage/layers.hpp"

#include <memory>

#include "host/kernel/prefix_sum.hpp"
#include "shared/ray.h"

namespace macula::stage {
namespace {

constexpr const char* kProgram = "shade/layers";

std::string through_of(const Kit& kit) {
    return kit.named("light through layers");
}

VariantTable variants_of(const Tracer& tracer) {
    VariantTable table;
    for (const kernel::RayClass ray_class : kernel::kRayClasses)
        table[static_cast<std::size_t>(ray_class)] = tracer.choice(ray_class);
    return table;
}

class CollectLayers {
  public:
    CollectLayers(const Kit& kit, std::string spreads)
        : kit_(kit), list_(kit.at_layers()), spreads_(std::move(spreads)),
          tracer_(kit.device, kit.library, kit.blended->geometry, variants_of(kit.tracer)),
          compaction_(kit.library, kit.device, std::uint64_t{kit.layers} * kit.slots()),
          collect_(kernel("collect_layers")), weigh_(kernel("weigh_layers")),
          entries_(kernel("list_layers")) {}

    void operator()(frame::Run& run) {
        const compute::Buffer none;
        const compute::Buffer& spreads = spreads_.empty() ? none : run[spreads_];
        const auto of = [&](const char* what) { return run[kit_.named(what)]; };
        const auto class_of_rays =
            kit_.primary() ? kernel::RayClass::sparse : kernel::RayClass::diffuse;
        compute::Buffer& layers = run.scratch("layer hits found");
        compute::Buffer& ids = run.scratch("layer triangles found");
        compute::Buffer& histogram = run.scratch("layer histogram");
        histogram.fill(0);
        // Most rays meet none, which packets find out sooner.
        tracer_.any(class_of_rays, run[kit_.rays()], of("ray count"), kit_.launched(),
                    run.scratch("rays that meet layers"), kit_.named("find layers"));
        frame::DeviceGeometry& geometry = kit_.blended->geometry;
        const frame::DeviceSurfaces& scene = kit_.blended->surfaces;
        const frame::LayoutBuffers& tree = geometry.layout(bvh::Layout::binary);
        collect_
            .set(run.params_buffer(), tree.nodes, tree.triangles, tree.instances,
                 geometry.upper_nodes(), scene.triangles, scene.vertices, scene.optics,
                 scene.textures, scene.levels, scene.texels, scene.decode, run[kit_.rays()],
                 of("ray count"), of("hits"), spreads, of("throughput"), of("origin"),
                 run.scratch("rays that meet layers"), kit_.layers, layers, ids,
                 run.scratch("layer counts"), run.scratch("layer remainders"), histogram)
            .launch(kit_.named("collect layers"), {kit_.launched()}, {kGroup});
        weigh_
            .set(of("ray count"), histogram, kit_.layers, list_.launched(),
                 run.scratch("layer counts"), run.scratch("layer remainders"), layers,
                 run.scratch("layer flags"), run.scratch("layer flag count"), run[through_of(kit_)])
            .launch(kit_.named("weigh layers"), {kit_.launched()}, {kGroup});
        compaction_.run(run.scratch("layer flags"), run.scratch("layer flag count"),
                        run.scratch("layer queue"), run.scratch("layer queue count"),
                        kit_.named("queue layers"), std::uint64_t{kit_.layers} * kit_.launched());
        entries_
            .set(run.params_buffer(), run.scratch("layer queue"), run.scratch("layer queue count"),
                 run[kit_.rays()], of("pixel of slot"), spreads, of("root"), of("throughput"),
                 of("origin"), kit_.layers, layers, ids, run[list_.rays()],
                 run[list_.named("hits")], run[list_.named("pixel of slot")],
                 run[list_.named("root")], run[list_.named("throughput")],
                 run[list_.named("origin")], run[list_.named("ray count")])
            .launch(kit_.named("list layers"), {list_.launched()}, {kGroup});
    }

  private:
    compute::Kernel kernel(const char* entry) const {
        return kit_.library.kernel(kernel::VariantKey(kProgram), entry, kit_.device);
    }

    Kit kit_, list_;
    std::string spreads_;
    Tracer tracer_;
    kernel::Compaction compaction_;
    compute::Kernel collect_, weigh_, entries_;
};

std::vector<frame::Resource> scratch_of(const Kit& kit) {
    const std::uint64_t most = std::uint64_t{kit.layers} * kit.slots();
    return {{"layer hits found", 16, most},     {"layer triangles found", 4, most},
            {"layer flags", 4, most},           {"layer flag count", 4, 1},
            {"layer queue", 4, most},           {"layer queue count", 4, 1},
            {"layer histogram", 4, kit.layers}, per_slot(kit, "rays that meet layers", 4),
            per_slot(kit, "layer counts", 4),   per_slot(kit, "layer remainders", 4)};
}

} // namespace

frame::Stage collect_layers(const Kit& kit, const std::string& spreads) {
    const Kit list = kit.at_layers();
    frame::Stage stage;
    stage.name = kit.named("collect layers");
    stage.reads = {kit.rays(), kit.named("ray count"), kit.named("pixel of slot"),
                   kit.named("hits")};
    if (!kit.primary())
        stage.reads.insert(stage.reads.end(),
                           {kit.named("root"), kit.named("throughput"), kit.named("origin")});
    if (!spreads.empty())
        stage.reads.push_back(spreads);
    stage.writes = {of_list(list, "rays", sizeof(shared::RayBlock), MACULA_RAY_BLOCK),
                    of_list(list, "hits", sizeof(shared::HitBlock), MACULA_RAY_BLOCK),
                    of_list(list, "pixel of slot", 4),
                    of_list(list, "root", 4),
                    of_list(list, "throughput", 16),
                    of_list(list, "origin", 16),
                    {list.named("ray count"), 4, 1},
                    per_slot(kit, through_of(kit), 4)};
    stage.scratch = scratch_of(kit);
    stage.prepare = [kit, spreads] {
        auto body = std::make_shared<CollectLayers>(kit, spreads);
        return [body](frame::Run& run) { (*body)(run); };
    };
    return stage;
}

frame::Stage add_layers(const Kit& kit, const std::string& total) {
    const Kit list = kit.at_layers();
    frame::Stage stage;
    stage.name = kit.named("blend layers");
    stage.reads = {total, list.named("ray count"), list.named("root"), list.named("throughput"),
                   list.named("surface colour")};
    if (kit.primary())
        stage.reads.push_back(through_of(kit));
    const std::string sum = "colour with " + kit.named("layers");
    stage.writes = {{sum, 16, kit.at_level(0).slots(), "surface colour"}};
    stage.prepare = [kit, list, sum, name = stage.name] {
        auto kernel = kit.library.kernel(kernel::VariantKey(kProgram), "add_layers", kit.device);
        const std::string through = kit.primary() ? through_of(kit) : "";
        return [list, sum, through, name, kernel](frame::Run& run) mutable {
            kernel
                .set(run[list.named("ray count")], run[list.named("root")],
                     run[list.named("throughput")], run[list.named("surface colour")],
                     through.empty() ? compute::Buffer() : run[through], run[sum])
                .launch(name, {list.launched()}, {kGroup});
        };
    };
    return stage;
}

} // namespace macula::stage
