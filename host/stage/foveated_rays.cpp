#include "host/stage/foveated_rays.hpp"

#include "host/kernel/prefix_sum.hpp"
#include "shared/ray.h"

namespace macula::stage {

frame::Stage choose_pixels(const FoveatedKit& kit) {
    frame::Stage stage;
    stage.name = "choose pixels";
    stage.reads = {"pixel keys", "history kept"};
    stage.writes = {{"sampling masks", 4, kit.packets()},
                    {"list offsets", 4, kit.packets()},
                    {"list length", 4, 1}};
    stage.prepare = [kit, name = stage.name] {
        kit.grid->prepare(kit.kit);
        const kernel::VariantKey key("generate/foveated");
        auto choose = kit.kit.library.kernel(key, "choose_pixels", kit.kit.device);
        auto sum =
            std::make_shared<kernel::PrefixSum>(kit.kit.library, kit.kit.device, kit.packets());
        const std::uint32_t packets = kit.packets();
        const compute::Buffer count =
            kit.kit.device.upload(std::span(&packets, 1), "number of packets");
        return [kit, name, choose, sum, count](frame::Run& run) mutable {
            // The counts become their own offsets.
            choose
                .set(run.params_buffer(), kit.grid->params_buffer, kit.grid->cell_columns,
                     kit.grid->cell_rows, run["pixel keys"], run["history kept"],
                     run["sampling masks"], run["list offsets"])
                .launch(name, {kit.packets()}, {kGroup});
            sum->exclusive(run["list offsets"], count, run["list offsets"], run["list length"],
                           "order the list");
        };
    };
    return stage;
}

frame::Stage listed_rays(const FoveatedKit& kit) {
    frame::Stage stage;
    stage.name = "generate listed rays";
    stage.reads = {"sampling masks", "list offsets", "list length"};
    stage.writes = {
        {"primary rays", sizeof(shared::RayBlock), kit.packets()},
        per_slot(kit.kit, "pixel of slot", 4),
        {"ray count", 4, 1},
    };
    stage.prepare = [kit, name = stage.name] {
        auto kernel = kit.kit.library.kernel(kernel::VariantKey("generate/foveated"),
                                             "generate_listed_rays", kit.kit.device);
        return [kit, name, kernel](frame::Run& run) mutable {
            kernel
                .set(run.params_buffer(), kit.grid->params_buffer, run.sample(),
                     run["sampling masks"], run["list offsets"], run["list length"],
                     run["primary rays"], run["pixel of slot"], run["ray count"],
                     kit.kit.ray_totals, static_cast<std::uint32_t>(kernel::RayClass::sparse))
                .launch(name, {kit.packets()}, {kGroup});
        };
    };
    return stage;
}

} // namespace macula::stage
