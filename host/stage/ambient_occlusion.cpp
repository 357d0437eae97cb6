#include "host/stage/ambient_occlusion.hpp"

#include <algorithm>
#include <memory>

#include "host/kernel/prefix_sum.hpp"
#include "host/stage/queue.hpp"

namespace macula::stage {
namespace {

class AmbientOcclusion {
  public:
    explicit AmbientOcclusion(const Kit& kit)
        : kit_(kit), compaction_(kit.library, kit.device, kit.slots()) {
        constexpr const char* program = "shade/ambient_occlusion";
        flag_ = kit.lane_kernel(program, "flag_surfaces");
        generate_ = kit.lane_kernel(program, "generate_ambient_occlusion_rays");
        average_ = kit.lane_kernel(program, "average_ambient_occlusion");
    }

    void operator()(frame::Run& run) {
        flag_
            .set(run[kit_.named("ray count")], run[kit_.named("surface triangle")],
                 run.scratch("queue flags"), run[kit_.named("surface openness")])
            .launch(kit_.named("flag surfaces"), kit_.lane_items(kit_.launched()),
                    kit_.lane_group());
        compaction_.run(run.scratch("queue flags"), run[kit_.named("ray count")],
                        run.scratch("queue"), run.scratch("queue count"),
                        kit_.named("queue surfaces"), kit_.launched());
        const std::uint32_t samples = kit_.ambient_occlusion_samples;
        const std::uint32_t entries = batch_entries(kit_, samples);
        for_each_batch(kit_, entries, [&](std::uint32_t first) {
            generate_
                .set(run.params_buffer(), run.sample(), run.scratch("queue"),
                     run.scratch("queue count"), first, run[kit_.named("pixel of slot")],
                     run[kit_.named("surface position")],
                     run[kit_.named("surface geometric normal")],
                     run[kit_.named("surface shading normal")], run.scratch("queued rays"),
                     run.scratch("queued ray count"), kit_.ray_totals,
                     static_cast<std::uint32_t>(kernel::RayClass::ambient_occlusion))
                .launch(kit_.named("generate ambient occlusion rays"), kit_.lane_items(entries),
                        kit_.lane_group());
            kit_.tracer.any(kernel::RayClass::ambient_occlusion, run.scratch("queued rays"),
                            run.scratch("queued ray count"), entries * samples,
                            run.scratch("occluded"), kit_.named("trace ambient occlusion rays"));
            average_
                .set(run.params_buffer(), run.scratch("queue"), run.scratch("queue count"), first,
                     run.scratch("occluded"), run[kit_.named("surface openness")])
                .launch(kit_.named("average ambient occlusion"), kit_.lane_items(entries),
                        kit_.lane_group());
        });
    }

  private:
    Kit kit_;
    kernel::Compaction compaction_;
    compute::Kernel flag_, generate_, average_;
};

} // namespace

frame::Stage ambient_occlusion(const Kit& kit) {
    frame::Stage stage;
    stage.name = kit.named("gather ambient occlusion");
    for (const char* read : {"ray count", "pixel of slot", "surface triangle", "surface position",
                             "surface geometric normal", "surface shading normal"})
        stage.reads.push_back(kit.named(read));
    stage.writes = {of_level(kit, "surface openness", 4)};
    stage.scratch = queue_scratch(kit, std::max(kit.ambient_occlusion_samples, 1u));
    stage.prepare = [kit] {
        auto body = std::make_shared<AmbientOcclusion>(kit);
        return [body](frame::Run& run) { (*body)(run); };
    };
    return stage;
}

} // namespace macula::stage
