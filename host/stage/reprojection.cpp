#include "host/stage/reprojection.hpp"

#include "lib/camera.h"
#include "lib/mesh_cells.h"

namespace macula::stage {
namespace {

constexpr std::size_t kJudges = 64; // work-items of the one group that judges the history
// Groups of items that are sixteen samples or cells, and of items that are tiles of the screen.
constexpr std::size_t kRowGroup = 8, kTileGroup = 2;

std::uint64_t blocks(const FoveatedKit& kit) {
    return shared::cell_blocks(kit.grid->params().support_width, kit.grid->params().support_height);
}

std::uint32_t key_rows(const FoveatedKit& kit) {
    return shared::tiles_across(kit.kit.height) * MACULA_TILE;
}

// Tables of lib/mesh_cells.h, field by field for blocks of cells.
frame::Resource per_cell(const FoveatedKit& kit, const std::string& name, std::uint32_t fields) {
    return {name, 4, blocks(kit) * MACULA_CELL_LANES * fields};
}

} // namespace

frame::Stage project_mesh(const FoveatedKit& kit) {
    frame::Stage stage;
    stage.name = "project the support mesh";
    stage.reads_last = {"support geometry"};
    stage.writes = {kit.per_support("mesh vertices", 16)};
    if (kit.can_move()) {
        stage.reads_last.push_back("support triangle");
        stage.writes.push_back(kit.per_support("support motion", 4));
    }
    stage.prepare = [kit, name = stage.name] {
        kit.grid->prepare(kit.kit);
        auto project = kit.kit.library.kernel(kernel::VariantKey("reproject/mesh"), "project_mesh",
                                              kit.kit.device);
        return [kit, name, project](frame::Run& run) mutable {
            const SupportGrid& grid = *kit.grid;
            const bool any = kit.can_move();
            if (any)
                kit.motions->update(kit.kit);
            const compute::Buffer none;
            project
                .set(run.params_buffer(), grid.params_buffer, grid.columns, grid.rows,
                     grid.mesh_columns, grid.mesh_rows, run.last("support geometry"), kit.moved(),
                     any ? kit.motions->instances() : 0u, any ? kit.motions->table : none,
                     any ? kit.motions->matrices : none, any ? run.last("support triangle") : none,
                     any ? run["support motion"] : none, run["mesh vertices"])
                .launch(name, {compute::Range::cover(blocks(kit), kRowGroup)}, {kRowGroup});
        };
    };
    return stage;
}

frame::Stage draw_mesh(const FoveatedKit& kit) {
    frame::Stage stage;
    stage.name = "detect errors and draw the mesh";
    stage.reads = {"mesh vertices"};
    stage.reads_last = {"support geometry", "support image"};
    if (kit.can_move()) {
        stage.reads.push_back("support motion");
        stage.reads_last.push_back("support change");
    }
    const std::uint64_t pitch = kit.grid->params().pitch;
    stage.writes = {kit.per_support("resampling info", 4),
                    per_cell(kit, "mesh cells", MACULA_CELL_FIELDS),
                    {"pixel keys", 4, pitch * key_rows(kit)}};
    stage.scratch = {per_cell(kit, "cell outlines", MACULA_OUTLINE_FIELDS),
                     per_cell(kit, "second outlines", MACULA_OUTLINE_FIELDS),
                     {"cell bounds", 4,
                      std::uint64_t{shared::bounds_pitch(kit.grid->params().support_width,
                                                         kit.grid->params().support_height)} *
                          MACULA_BOUNDS_FIELDS}};
    stage.prepare = [kit, pitch, name = stage.name] {
        kit.grid->prepare(kit.kit);
        auto prepare = kit.kit.library.kernel(kernel::VariantKey("reproject/cells"),
                                              "prepare_cells", kit.kit.device);
        const std::uint32_t wide = kit.kit.lanes == 1 ? MACULA_DRAWN_TILE : 4 * MACULA_DRAWN_TILE;
        auto draw =
            kit.kit.library.kernel(kernel::VariantKey("reproject/draw").parameter("wide", wide),
                                   "draw_mesh", kit.kit.device);
        const std::uint64_t tiles = (pitch + wide - 1) / wide * (key_rows(kit) / MACULA_DRAWN_TILE);
        return [kit, tiles, name, prepare, draw](frame::Run& run) mutable {
            const SupportGrid& grid = *kit.grid;
            const bool any = kit.can_move();
            const compute::Buffer none;
            prepare
                .set(run.params_buffer(), grid.params_buffer, grid.mesh_columns, grid.mesh_rows,
                     run.last("support geometry"), run.last("support image"), run["mesh vertices"],
                     kit.moved(), any ? kit.motions->matrices : none,
                     any ? run["support motion"] : none, any ? run.last("support change") : none,
                     run["resampling info"], run["mesh cells"], run.scratch("cell outlines"),
                     run.scratch("second outlines"), run.scratch("cell bounds"))
                .launch(name, {compute::Range::cover(blocks(kit), kRowGroup)}, {kRowGroup});
            draw.set(grid.params_buffer, run.scratch("cell outlines"),
                     run.scratch("second outlines"), run.scratch("cell bounds"), key_rows(kit),
                     run["pixel keys"])
                .launch(name, {compute::Range::cover(tiles, kTileGroup)}, {kTileGroup});
        };
    };
    return stage;
}

frame::Stage judge_history(const FoveatedKit& kit) {
    frame::Stage stage;
    stage.name = "judge the history";
    stage.reads = {"resampling info"};
    stage.reads_last = {"support geometry"};
    stage.writes = {{"history kept", 4, 1}};
    stage.prepare = [kit, name = stage.name] {
        auto judge = kit.kit.library.kernel(kernel::VariantKey("reproject/mesh"), "judge_history",
                                            kit.kit.device);
        return [kit, name, judge](frame::Run& run) mutable {
            judge
                .set(run.params_buffer(), kit.grid->params_buffer, run["resampling info"],
                     run.last("support geometry"),
                     compute::LocalMemory{2 * kJudges * sizeof(std::uint32_t)}, run["history kept"])
                .launch(name, {kJudges}, {kJudges});
        };
    };
    return stage;
}

} // namespace macula::stage
