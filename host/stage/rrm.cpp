#include "host/stage/rrm.hpp"

#include "shared/ray.h"

namespace macula::stage {
namespace {

constexpr const char* kProgram = "refresh/refresh";
constexpr std::size_t kCounters = 64; // work-items that add up the counts

compute::Kernel kernel_of(const RrmKit& kit, const char* entry) {
    return kit.kit.library.kernel(kernel::VariantKey(kProgram)
                                      .parameter("lanes", kit.kit.lanes)
                                      .parameter("block_width", kit.cycle->options().block_width),
                                  entry, kit.kit.device);
}

} // namespace

frame::Stage plan_refresh(const RrmKit& kit) {
    frame::Stage stage;
    stage.name = "plan the refresh";
    stage.writes = {{"refresh plan", sizeof(shared::RefreshPlan), 1}};
    stage.prepare = [kit] {
        return [kit](frame::Run& run) {
            run["refresh plan"].write_one(kit.cycle->plan(run.params(), run.first_frame()));
        };
    };
    return stage;
}

frame::Stage refreshed_rays(const RrmKit& kit) {
    frame::Stage stage;
    stage.name = "generate refreshed rays";
    stage.reads = {"refresh plan"};
    stage.writes = {
        {"primary rays", sizeof(shared::RayBlock), kit.kit.slots() / MACULA_RAY_BLOCK},
        per_slot(kit.kit, "pixel of slot", 4),
        {"ray count", 4, 1},
    };
    stage.scratch = {{"refreshed pixels", 4, kit.kit.slots() / kit.kit.lanes}};
    stage.prepare = [kit, name = stage.name] {
        auto generate = kernel_of(kit, "generate_refreshed_rays");
        auto count = kernel_of(kit, "count_refreshed");
        const std::vector<std::uint32_t> places = refresh_orders(kit.cycle->options());
        const compute::Buffer orders = kit.kit.device.upload(std::span(places), "refresh orders");
        return [kit, name, generate, count, orders](frame::Run& run) mutable {
            const Kit& k = kit.kit;
            generate
                .set(run.params_buffer(), run["refresh plan"], orders, run.sample(),
                     run["primary rays"], run["pixel of slot"], run["ray count"],
                     run.scratch("refreshed pixels"))
                .launch(name, k.lane_items(k.launched()), k.lane_group());
            count
                .set(run.scratch("refreshed pixels"), k.launched() / k.lanes,
                     compute::LocalMemory{kCounters * sizeof(std::uint32_t)}, k.ray_totals,
                     static_cast<std::uint32_t>(kernel::RayClass::sparse))
                .launch("generate refreshed rays: count", {kCounters}, {kCounters});
        };
    };
    return stage;
}

frame::Stage persistent(frame::Stage stage) {
    stage.prepare = [image = stage.writes.front().name, prepare = stage.prepare] {
        return [image, body = prepare()](frame::Run& run) {
            if (run.first_frame() && run.sample() == 0)
                run[image].fill(0);
            body(run);
        };
    };
    return stage;
}

} // namespace macula::stage
