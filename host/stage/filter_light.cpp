#include "host/stage/filter_light.hpp"

namespace macula::stage {
namespace {

// The list fills the first part of the launch alone: small groups share that out.
constexpr std::size_t kListGroup = 8;

} // namespace

frame::Stage filter_light(const FoveatedKit& kit, const std::string& light,
                          const std::string& buffer, std::uint32_t light_bytes) {
    frame::Stage stage;
    stage.name = "post-process: light of neighbours";
    stage.reads = {"mesh vertices", "pixel keys",    "history kept", "ray count",
                   "pixel of slot", "surface depth", light};
    if (kit.can_move())
        stage.reads.push_back("resampling info");
    stage.reads_last = {buffer};
    stage.writes = {per_slot(kit.kit, "filtered light", light_bytes)};
    stage.prepare = [kit, light, buffer, light_bytes, name = stage.name] {
        kit.grid->prepare(kit.kit);
        const auto key =
            kernel::VariantKey("cache/filter_light").parameter("light", light_bytes / 4);
        auto kernel = kit.kit.library.kernel(key, "filter_light", kit.kit.device);
        return [kit, light, buffer, name, kernel](frame::Run& run) mutable {
            const SupportGrid& grid = *kit.grid;
            const compute::Buffer none;
            kernel
                .set(run.params_buffer(), grid.params_buffer, run.sample(), grid.mesh_columns,
                     grid.mesh_rows, run["mesh vertices"], run["pixel keys"], run["history kept"],
                     kit.can_move() ? run["resampling info"] : none, run.last(buffer),
                     run["ray count"], run["pixel of slot"], run["surface depth"], run[light],
                     run["filtered light"])
                .launch(name, {kit.packets()}, {kListGroup});
        };
    };
    return stage;
}

} // namespace macula::stage
