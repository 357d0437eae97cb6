#include "host/stage/light.hpp"

#include <algorithm>
#include <memory>

#include "host/frame/blue_noise.hpp"
#include "host/kernel/prefix_sum.hpp"
#include "host/stage/queue.hpp"

namespace macula::stage {
namespace {

bool takes_blue_noise(const shared::Light& light) {
    return light.columns == 0;
}

class DirectLight {
  public:
    DirectLight(const Kit& kit, PlaceRows rows)
        : kit_(kit), rows_{rows.pixels > 0 ? rows.pixels : kit.width, rows.texels},
          compaction_(kit.library, kit.device, kit.slots()) {
        constexpr const char* program = "shade/light";
        flag_ = kit.lane_kernel(program, "flag_lit_surfaces");
        generate_ = kit.lane_kernel(program, "generate_shadow_rays");
        add_ = kit.lane_kernel(program, "add_light");
        lights_ = kit.device.upload(std::span(kit.lights), "lights");
        if (std::any_of(kit.lights.begin(), kit.lights.end(), takes_blue_noise))
            noise_ = kit.device.upload(std::span(frame::blue_noise()), "blue noise");
    }

    void operator()(frame::Run& run) {
        if (kit_.lights.empty())
            clear(run);
        for (std::uint32_t light = 0; light < kit_.lights.size(); ++light)
            one_light(run, light);
    }

  private:
    // Otherwise the first light does it.
    void clear(frame::Run& run) const {
        run[kit_.named("surface irradiance")].fill(0);
        if (run[kit_.named("surface highlight")])
            run[kit_.named("surface highlight")].fill(0);
    }

    void one_light(frame::Run& run, std::uint32_t light) {
        flag_
            .set(run[kit_.named("ray count")], run[kit_.named("surface triangle")],
                 run[kit_.named("surface position")], run[kit_.named("surface geometric normal")],
                 lights_, light, run.scratch("queue flags"), run[kit_.named("surface irradiance")],
                 run[kit_.named("surface highlight")])
            .launch(kit_.named("flag lit surfaces"), kit_.lane_items(kit_.launched()),
                    kit_.lane_group());
        compaction_.run(run.scratch("queue flags"), run[kit_.named("ray count")],
                        run.scratch("queue"), run.scratch("queue count"),
                        kit_.named("queue lit surfaces"), kit_.launched());
        const std::uint32_t samples = kit_.lights[light].samples;
        const std::uint32_t entries = batch_entries(kit_, samples);
        for_each_batch(kit_, entries, [&](std::uint32_t first) {
            generate_
                .set(run.params_buffer(), run.sample(), lights_, light, rows_.pixels, rows_.texels,
                     noise_, run.scratch("queue"), run.scratch("queue count"), first,
                     run[kit_.named("pixel of slot")], run[kit_.named("surface position")],
                     run[kit_.named("surface geometric normal")], run.scratch("queued rays"),
                     run.scratch("queued ray count"), kit_.ray_totals,
                     static_cast<std::uint32_t>(kernel::RayClass::shadow))
                .launch(kit_.named("generate shadow rays"), kit_.lane_items(entries * samples),
                        kit_.lane_group());
            kit_.tracer.any(kernel::RayClass::shadow, run.scratch("queued rays"),
                            run.scratch("queued ray count"), entries * samples,
                            run.scratch("occluded"), kit_.named("trace shadow rays"));
            add_.set(run.params_buffer(), run.sample(), lights_, light, rows_.pixels, rows_.texels,
                     noise_, run.scratch("queue"), run.scratch("queue count"), first,
                     run[kit_.named("pixel of slot")], run[kit_.named("surface position")],
                     run[kit_.named("surface geometric normal")],
                     run[kit_.named("surface shading normal")], run[kit_.named("surface specular")],
                     run[kit_.named("origin")], run.scratch("occluded"),
                     run[kit_.named("surface irradiance")], run[kit_.named("surface highlight")])
                .launch(kit_.named("add light"), kit_.lane_items(entries), kit_.lane_group());
        });
    }

    Kit kit_;
    PlaceRows rows_;
    kernel::Compaction compaction_;
    compute::Kernel flag_, generate_, add_;
    compute::Buffer lights_, noise_;
};

} // namespace

frame::Stage direct_light(const Kit& kit, PlaceRows rows) {
    std::uint32_t samples = 1;
    for (const shared::Light& light : kit.lights)
        samples = std::max(samples, light.samples);
    frame::Stage stage;
    stage.name = kit.named("gather direct light");
    for (const char* read : {"ray count", "pixel of slot", "surface triangle", "surface position",
                             "surface geometric normal", "surface shading normal"})
        stage.reads.push_back(kit.named(read));
    if (kit.highlights)
        stage.reads.push_back(kit.named("surface specular"));
    if (!kit.primary())
        stage.reads.push_back(kit.named("origin"));
    stage.writes = {of_level(kit, "surface irradiance", 16),
                    of_level(kit, "surface highlight", 16)};
    stage.scratch = queue_scratch(kit, samples);
    stage.prepare = [kit, rows] {
        auto body = std::make_shared<DirectLight>(kit, rows);
        return [body](frame::Run& run) { (*body)(run); };
    };
    return stage;
}

} // namespace macula::stage
