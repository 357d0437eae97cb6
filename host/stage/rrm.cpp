#include "host/stage/rrm.hpp"

#include "host/kernel/prefix_sum.hpp"
#include "shared/ray.h"

namespace macula::stage {
namespace {

constexpr std::size_t kCounters = 64; // work-items that add up the counts
constexpr const char* kRays = "refresh/refresh";
constexpr const char* kKeep = "refresh/keep";

compute::Kernel kernel_of(const RrmKit& kit, const char* program, const char* entry) {
    return kit.kit.library.kernel(kernel::VariantKey(program)
                                      .parameter("lanes", program == kRays ? kit.kit.lanes : 1)
                                      .parameter("block_width", kit.cycle->options().block_width),
                                  entry, kit.kit.device);
}

bool looks_for_busy(const RrmKit& kit) {
    return kit.cycle->options().busy.wanted();
}

// The busy groups of the frames before, in the order of the search.
class BusyQuads {
  public:
    explicit BusyQuads(const RrmKit& kit)
        : kit_(kit), flag_(kernel_of(kit, kKeep, "flag_busy")),
          compaction_(kit.kit.library, kit.kit.device, kit.cycle->quads()) {
        const std::uint32_t quads = kit.cycle->quads();
        count_ = kit.kit.device.upload(std::span(&quads, 1), "number of quads");
    }

    void operator()(frame::Run& run) {
        if (run.first_frame())
            run["busy until"].fill(0);
        const auto group = static_cast<std::uint32_t>(kGroup);
        const std::uint32_t items = (kit_.cycle->quads() + group - 1) / group * group;
        flag_.set(run["refresh plan"], run["busy until"], run.scratch("busy flags"))
            .launch("flag busy groups", {items}, {kGroup});
        compaction_.run(run.scratch("busy flags"), count_, run["busy quads"],
                        run["busy quad count"], "queue busy groups");
    }

  private:
    RrmKit kit_;
    compute::Kernel flag_;
    kernel::Compaction compaction_;
    compute::Buffer count_;
};

compute::Buffer upload_table(const RrmKit& kit, const std::vector<std::uint32_t>& table,
                             const char* what) {
    return kit.kit.device.upload(std::span(table), what);
}

} // namespace

frame::Stage plan_refresh(const RrmKit& kit) {
    frame::Stage stage;
    stage.name = "plan the refresh";
    stage.writes = {{"refresh plan", sizeof(shared::RefreshPlan), 1}};
    if (looks_for_busy(kit)) {
        stage.writes.insert(stage.writes.end(), {{"busy until", 4, kit.cycle->quads()},
                                                 {"busy quads", 4, kit.cycle->quads()},
                                                 {"busy quad count", 4, 1}});
        stage.scratch = {{"busy flags", 4, kit.cycle->quads()}};
    }
    stage.prepare = [kit] {
        std::shared_ptr<BusyQuads> busy;
        if (looks_for_busy(kit))
            busy = std::make_shared<BusyQuads>(kit);
        return [kit, busy](frame::Run& run) {
            run["refresh plan"].write_one(kit.cycle->plan(run.params(), run.first_frame()));
            if (busy)
                (*busy)(run);
        };
    };
    return stage;
}

frame::Stage refreshed_rays(const RrmKit& kit) {
    frame::Stage stage;
    stage.name = "generate refreshed rays";
    stage.reads = {"refresh plan"};
    if (looks_for_busy(kit))
        stage.reads.insert(stage.reads.end(), {"busy quads", "busy quad count"});
    stage.writes = {
        {"primary rays", sizeof(shared::RayBlock), kit.kit.slots() / MACULA_RAY_BLOCK},
        per_slot(kit.kit, "pixel of slot", 4),
        {"ray count", 4, 1},
    };
    stage.scratch = {{"refreshed pixels", 4, kit.kit.slots() / kit.kit.lanes}};
    stage.prepare = [kit, name = stage.name] {
        auto generate = kernel_of(kit, kRays, "generate_refreshed_rays");
        auto count = kernel_of(kit, kRays, "count_refreshed");
        const RrmOptions& options = kit.cycle->options();
        const auto orders = upload_table(kit, refresh_orders(options), "refresh orders");
        const auto ranks = upload_table(kit, refresh_ranks(options), "refresh ranks");
        return [kit, name, generate, count, orders, ranks](frame::Run& run) mutable {
            const Kit& k = kit.kit;
            kit.cycle->begin_sample(run.sample());
            generate
                .set(run.params_buffer(), run["refresh plan"], orders, ranks, run["busy quads"],
                     run["busy quad count"], run.sample(), run["primary rays"],
                     run["pixel of slot"], run["ray count"], run.scratch("refreshed pixels"))
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

frame::Stage keep_refreshed(const RrmKit& kit, const std::string& from) {
    const bool busy = looks_for_busy(kit);
    const bool motion = kit.cycle->options().busy.motion > 0.0f;
    frame::Stage stage;
    stage.name = "average colour";
    stage.reads = {"refresh plan", "ray count", "pixel of slot", from};
    if (busy)
        stage.reads.emplace_back("busy until");
    if (motion)
        stage.reads.emplace_back("surface motion");
    stage.writes = {per_pixel(kit.kit, "colour", 16)};
    stage.prepare = [kit, from, busy, motion, name = stage.name] {
        auto kernel = kernel_of(kit, kKeep, "keep_refreshed");
        return [kit, from, busy, motion, name, kernel](frame::Run& run) mutable {
            const compute::Buffer none;
            kernel
                .set(run.params_buffer(), run["refresh plan"], run.sample(), run["ray count"],
                     run["pixel of slot"], run[from], motion ? run["surface motion"] : none,
                     busy ? run["busy until"] : none, run["colour"])
                .launch(name, {kit.kit.launched()}, {kGroup});
        };
    };
    return persistent(stage, true);
}

frame::Stage note_refresh(const RrmKit& kit) {
    frame::Stage stage;
    stage.name = "place refreshes";
    stage.reads = {"refresh plan", "ray count", "pixel of slot"};
    stage.writes = {per_pixel(kit.kit, "refreshed at", 4)};
    stage.prepare = [kit, name = stage.name] {
        auto kernel = kernel_of(kit, kKeep, "note_refresh");
        return [kit, name, kernel](frame::Run& run) mutable {
            kernel
                .set(run["refresh plan"], run["ray count"], run["pixel of slot"],
                     run["refreshed at"])
                .launch(name, {kit.kit.launched()}, {kGroup});
        };
    };
    return persistent(stage);
}

frame::Stage show_age(const RrmKit& kit) {
    frame::Stage stage;
    stage.name = "place ages";
    stage.reads = {"refresh plan", "refreshed at"};
    stage.writes = {per_pixel(kit.kit, "cache age", 4)};
    stage.prepare = [kit, name = stage.name] {
        auto kernel = kernel_of(kit, kKeep, "show_age");
        return [kit, name, kernel](frame::Run& run) mutable {
            const auto pixels = static_cast<std::uint32_t>(kit.kit.pixels());
            kernel.set(run["refresh plan"], pixels, run["refreshed at"], run["cache age"])
                .launch(name, {kit.kit.slots()}, {kGroup});
        };
    };
    return stage;
}

frame::Stage persistent(frame::Stage stage, bool foveal) {
    stage.prepare = [foveal, image = stage.writes.front().name, prepare = stage.prepare] {
        return [foveal, image, body = prepare()](frame::Run& run) {
            if (run.first_frame() && run.sample() == 0)
                run[image].fill(0);
            if (foveal || run.sample() < run.params().samples_per_pixel)
                body(run);
        };
    };
    return stage;
}

} // namespace macula::stage
