#include "host/stage/show.hpp"

namespace macula::stage {

frame::Stage show_intermediates(const FoveatedKit& kit) {
    frame::Stage stage;
    stage.name = "show what lies between";
    stage.reads = {"sampling masks",  "pixel keys", "history kept",
                   "resampling info", "cache info", "support image"};
    stage.writes = {per_pixel(kit.kit, "sampling", 4), per_pixel(kit.kit, "resampling", 4),
                    per_pixel(kit.kit, "cache age", 4), per_pixel(kit.kit, "rho", 4),
                    per_pixel(kit.kit, "support colour", 16)};
    stage.prepare = [kit, name = stage.name] {
        auto kernel = kit.kit.library.kernel(kernel::VariantKey("cache/show"), "show_intermediates",
                                             kit.kit.device);
        return [kit, name, kernel](frame::Run& run) mutable {
            kernel
                .set(run.params_buffer(), kit.grid->params_buffer, run["sampling masks"],
                     run["pixel keys"], run["history kept"], run["resampling info"],
                     run["cache info"], run["support image"], run["sampling"], run["resampling"],
                     run["cache age"], run["rho"], run["support colour"])
                .launch(name, {kit.kit.slots()}, {kGroup});
        };
    };
    return stage;
}

frame::Stage draw_overlay(const FoveatedKit& kit) {
    frame::Stage stage;
    stage.name = "draw the overlay";
    stage.reads = {"sampling masks", kit.image};
    stage.writes = {per_pixel(kit.kit, "colour", 16)};
    stage.prepare = [kit, name = stage.name] {
        auto kernel = kit.kit.library.kernel(kernel::VariantKey("cache/show"), "draw_overlay",
                                             kit.kit.device);
        return [kit, name, kernel](frame::Run& run) mutable {
            kernel
                .set(run.params_buffer(), kit.grid->params_buffer, run["sampling masks"],
                     run[kit.image], run["colour"])
                .launch(name, {kit.kit.slots()}, {kGroup});
        };
    };
    return stage;
}

} // namespace macula::stage
