#include "host/stage/reprojection.hpp"

#include "lib/camera.h"

namespace macula::stage {
namespace {

constexpr std::size_t kJudges = 64; // work-items of the one group that judges the history

std::size_t support_range(const FoveatedKit& kit) {
    return compute::Range::cover(kit.grid->samples(), kGroup);
}

} // namespace

frame::Stage project_mesh(const FoveatedKit& kit) {
    frame::Stage stage;
    stage.name = "project the support mesh";
    stage.reads_last = {"support geometry"};
    stage.writes = {kit.per_support("mesh vertices", 16)};
    stage.prepare = [kit, name = stage.name] {
        kit.grid->prepare(kit.kit);
        auto project = kit.kit.library.kernel(kernel::VariantKey("reproject/mesh"), "project_mesh",
                                              kit.kit.device);
        return [kit, name, project](frame::Run& run) mutable {
            const SupportGrid& grid = *kit.grid;
            project
                .set(run.params_buffer(), grid.params_buffer, grid.columns, grid.rows,
                     grid.mesh_columns, grid.mesh_rows, run.last("support geometry"),
                     run["mesh vertices"])
                .launch(name, {support_range(kit)}, {kGroup});
        };
    };
    return stage;
}

frame::Stage draw_mesh(const FoveatedKit& kit) {
    frame::Stage stage;
    stage.name = "detect errors and draw the mesh";
    stage.reads = {"mesh vertices"};
    stage.reads_last = {"support geometry", "support image"};
    const std::uint64_t rows = std::uint64_t{shared::tiles_across(kit.kit.height)} * MACULA_TILE;
    stage.writes = {kit.per_support("resampling info", 4),
                    {"pixel keys", 4, kit.grid->params().pitch * rows}};
    stage.prepare = [kit, name = stage.name] {
        kit.grid->prepare(kit.kit);
        auto draw = kit.kit.library.kernel(kernel::VariantKey("reproject/mesh"), "draw_mesh",
                                           kit.kit.device);
        return [kit, name, draw](frame::Run& run) mutable {
            const SupportGrid& grid = *kit.grid;
            run["pixel keys"].fill(MACULA_NO_KEY);
            draw.set(run.params_buffer(), grid.params_buffer, grid.mesh_columns, grid.mesh_rows,
                     run.last("support geometry"), run.last("support image"), run["mesh vertices"],
                     run["resampling info"], run["pixel keys"])
                .launch(name, {support_range(kit)}, {kGroup});
        };
    };
    return stage;
}

frame::Stage judge_history(const FoveatedKit& kit) {
    frame::Stage stage;
    stage.name = "judge the history";
    stage.reads = {"resampling info"};
    stage.writes = {{"history kept", 4, 1}};
    stage.prepare = [kit, name = stage.name] {
        auto judge = kit.kit.library.kernel(kernel::VariantKey("reproject/mesh"), "judge_history",
                                            kit.kit.device);
        return [kit, name, judge](frame::Run& run) mutable {
            judge
                .set(kit.grid->params_buffer, run["resampling info"],
                     compute::LocalMemory{kJudges * sizeof(std::uint32_t)}, run["history kept"])
                .launch(name, {kJudges}, {kJudges});
        };
    };
    return stage;
}

} // namespace macula::stage
