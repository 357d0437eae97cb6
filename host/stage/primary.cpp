#include "host/stage/primary.hpp"

#include "shared/ray.h"

namespace macula::stage {

frame::Stage primary_rays(const Kit& kit) {
    frame::Stage stage;
    stage.name = "generate primary rays";
    stage.writes = {
        {"primary rays", sizeof(shared::RayBlock), kit.slots() / MACULA_RAY_BLOCK},
        per_slot(kit, "pixel of slot", 4),
        {"ray count", 4, 1},
    };
    stage.prepare = [kit, name = stage.name] {
        auto kernel = kit.library.kernel(kernel::VariantKey("generate/primary"),
                                         "generate_primary_rays", kit.device);
        return [kit, name, kernel](frame::Run& run) mutable {
            kernel
                .set(run.params_buffer(), run.sample(), run["primary rays"], run["pixel of slot"],
                     run["ray count"], kit.ray_totals,
                     static_cast<std::uint32_t>(kernel::RayClass::primary))
                .launch(name, {kit.launched()}, {kGroup});
        };
    };
    return stage;
}

frame::Stage trace_primary_rays(const Kit& kit, kernel::RayClass ray_class) {
    frame::Stage stage;
    stage.name = "trace primary rays";
    stage.reads = {"primary rays", "ray count"};
    stage.writes = {{"hits", sizeof(shared::HitBlock), kit.slots() / MACULA_RAY_BLOCK}};
    stage.prepare = [kit, ray_class, name = stage.name] {
        return [kit, ray_class, name](frame::Run& run) {
            kit.tracer.closest(ray_class, run["primary rays"], run["ray count"], kit.launched(),
                               run["hits"], name);
        };
    };
    return stage;
}

} // namespace macula::stage
