#include "host/stage/secondary.hpp"

#include <memory>

#include "host/kernel/prefix_sum.hpp"
#include "shared/ray.h"

namespace macula::stage {
namespace {

constexpr const char* kProgram = "shade/secondary";
constexpr std::uint32_t kClasses = 16; // of weight, with room to spare

class SecondaryRays {
  public:
    SecondaryRays(const Kit& kit, std::string spreads)
        : kit_(kit), last_(kit.at_level(kit.level - 1)), spreads_(std::move(spreads)),
          compaction_(kit.library, kit.device, std::uint64_t{kRaysOfHit} * last_.slots()),
          flag_(kit.lane_kernel(kProgram, "flag_secondary_rays")),
          limit_(kit.lane_kernel(kProgram, "limit_secondary_rays")),
          generate_(kit.lane_kernel(kProgram, "generate_secondary_rays")) {}

    void operator()(frame::Run& run) {
        // What goes through the layers before primary hits is taken off last of all.
        const auto last = [&](const std::string& what) {
            return last_.level == 0 && what == "light through layers" ? compute::Buffer()
                                                                      : run[last_.named(what)];
        };
        const auto next = [&](const char* what) { return run[kit_.named(what)]; };
        compute::Buffer& flags = run.scratch("secondary flags");
        compute::Buffer& flag_count = run.scratch("secondary flag count");
        compute::Buffer& histogram = run.scratch("secondary classes");
        histogram.fill(0);
        flag_
            .set(last("ray count"), run[last_.rays()], last("surface triangle"),
                 last("surface material"), last("surface geometric normal"),
                 last("surface shading normal"), last("throughput"), last("light through layers"),
                 kit_.surfaces.optics, flags, flag_count, histogram)
            .launch(kit_.named("flag rays"), kit_.lane_items(last_.launched()), kit_.lane_group());
        limit_.set(flag_count, histogram, kit_.launched(), flags)
            .launch(kit_.named("limit rays"), kit_.lane_items(kRaysOfHit * last_.launched()),
                    kit_.lane_group());
        compaction_.run(flags, flag_count, run.scratch("secondary queue"),
                        run.scratch("secondary queue count"), kit_.named("queue rays"),
                        std::uint64_t{kRaysOfHit} * last_.launched());
        const compute::Buffer none;
        const bool first = last_.level == 0;
        generate_
            .set(run.params_buffer(), run.scratch("secondary queue"),
                 run.scratch("secondary queue count"), run[last_.rays()],
                 first && !spreads_.empty() ? run[spreads_] : none, last("pixel of slot"),
                 last("root"), last("throughput"), last("light through layers"), last("origin"),
                 last("surface depth"), last("surface position"), last("surface material"),
                 last("surface geometric normal"), last("surface shading normal"),
                 kit_.surfaces.optics, next("rays"), next("pixel of slot"), next("root"),
                 next("throughput"), next("origin"), next("ray count"), kit_.ray_totals,
                 static_cast<std::uint32_t>(kernel::RayClass::diffuse))
            .launch(kit_.named("generate rays"), kit_.lane_items(kit_.launched()),
                    kit_.lane_group());
    }

  private:
    Kit kit_, last_;
    std::string spreads_;
    kernel::Compaction compaction_;
    compute::Kernel flag_, limit_, generate_;
};

} // namespace

frame::Stage secondary_rays(const Kit& kit, const std::string& spreads) {
    const Kit last = kit.at_level(kit.level - 1);
    frame::Stage stage;
    stage.name = kit.named("generate rays");
    stage.reads = {last.rays()};
    for (const char* read :
         {"ray count", "pixel of slot", "surface depth", "surface position", "surface triangle",
          "surface material", "surface geometric normal", "surface shading normal"})
        stage.reads.push_back(last.named(read));
    if (last.level > 0 && kit.layers > 0)
        stage.reads.push_back(last.named("light through layers"));
    if (last.level > 0)
        stage.reads.insert(stage.reads.end(),
                           {last.named("root"), last.named("throughput"), last.named("origin")});
    else if (!spreads.empty())
        stage.reads.push_back(spreads);
    stage.writes = {of_list(kit, "rays", sizeof(shared::RayBlock), MACULA_RAY_BLOCK),
                    of_list(kit, "pixel of slot", 4),
                    of_list(kit, "root", 4),
                    of_list(kit, "throughput", 16),
                    of_list(kit, "origin", 16),
                    {kit.named("ray count"), 4, 1}};
    const std::uint64_t most = std::uint64_t{kRaysOfHit} * last.slots();
    stage.scratch = {{"secondary flags", 4, most},
                     {"secondary flag count", 4, 1},
                     {"secondary classes", 4, kClasses},
                     {"secondary queue", 4, most},
                     {"secondary queue count", 4, 1}};
    stage.prepare = [kit, spreads] {
        auto body = std::make_shared<SecondaryRays>(kit, spreads);
        return [body](frame::Run& run) { (*body)(run); };
    };
    return stage;
}

frame::Stage trace_secondary_rays(const Kit& kit) {
    frame::Stage stage;
    stage.name = kit.named("trace rays");
    stage.reads = {kit.named("rays"), kit.named("ray count")};
    stage.writes = {{kit.named("hits"), sizeof(shared::HitBlock), kit.slots() / MACULA_RAY_BLOCK,
                     "bounce hits"}};
    stage.prepare = [kit, name = stage.name] {
        return [kit, name](frame::Run& run) {
            kit.tracer.closest(kernel::RayClass::diffuse, run[kit.named("rays")],
                               run[kit.named("ray count")], kit.launched(), run[kit.named("hits")],
                               name);
        };
    };
    return stage;
}

frame::Stage add_secondary_light(const Kit& kit, const std::string& total) {
    frame::Stage stage;
    stage.name = kit.named("add light of rays");
    stage.reads = {total, kit.named("ray count"), kit.named("root"), kit.named("throughput"),
                   kit.named("surface colour")};
    if (kit.layers > 0)
        stage.reads.push_back(kit.named("light through layers"));
    const std::string sum = "colour after bounce " + std::to_string(kit.level);
    stage.writes = {{sum, 16, kit.at_level(0).slots(), "surface colour"}};
    stage.prepare = [kit, sum, name = stage.name] {
        auto kernel =
            kit.library.kernel(kernel::VariantKey(kProgram), "add_secondary_rays", kit.device);
        return [kit, sum, name, kernel](frame::Run& run) mutable {
            kernel
                .set(run[kit.named("ray count")], run[kit.named("root")],
                     run[kit.named("throughput")], run[kit.named("light through layers")],
                     run[kit.named("surface colour")], run[sum])
                .launch(name, {kit.launched()}, {kGroup});
        };
    };
    return stage;
}

} // namespace macula::stage
