#include "host/stage/lowres.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "lib/camera.h"
#include "shared/ray.h"

namespace macula::stage {

Coarse coarse_size(const Kit& kit, float scale) {
    if (!(scale > 0.0f && scale <= 1.0f))
        throw std::invalid_argument(
            fmt::format("method lowres: the scale must be above 0 and at most 1, not {}", scale));
    const auto scaled = [&](std::uint32_t pixels) {
        return std::max(static_cast<std::uint32_t>(std::lround(double{scale} * pixels)), 1u);
    };
    return {scaled(kit.width), scaled(kit.height)};
}

frame::Stage grid_rays(const Kit& kit, Coarse size) {
    frame::Stage stage;
    stage.name = "generate grid rays";
    stage.writes = {
        {"primary rays", sizeof(shared::RayBlock), kit.slots() / MACULA_RAY_BLOCK},
        per_slot(kit, "pixel of slot", 4),
        {"ray count", 4, 1},
    };
    stage.prepare = [kit, size, name = stage.name] {
        auto kernel = kit.library.kernel(kernel::VariantKey("generate/grid"), "generate_grid_rays",
                                         kit.device);
        return [kit, size, name, kernel](frame::Run& run) mutable {
            kernel
                .set(run.params_buffer(), size.width, size.height, run.sample(),
                     run["primary rays"], run["pixel of slot"], run["ray count"], kit.ray_totals,
                     static_cast<std::uint32_t>(kernel::RayClass::primary))
                .launch(name, {shared::slot_count(size.width, size.height)}, {kGroup});
        };
    };
    return stage;
}

frame::Stage enlarge(const Kit& kit, Coarse size) {
    frame::Stage stage;
    stage.name = "enlarge";
    stage.reads = {"sampled colour"};
    stage.writes = {per_pixel(kit, "colour", 16)};
    stage.prepare = [kit, size, name = stage.name] {
        auto kernel =
            kit.library.kernel(kernel::VariantKey("remap/bicubic"), "enlarge_bicubic", kit.device);
        return [kit, size, name, kernel](frame::Run& run) mutable {
            kernel
                .set(run.params_buffer(), size.width, size.height, run["sampled colour"],
                     run["colour"])
                .launch(name, {kit.slots()}, {kGroup});
        };
    };
    return stage;
}

} // namespace macula::stage
