#include "host/stage/cache.hpp"

#include "shared/planes.h"

namespace macula::stage {
namespace {

// Packets of 4 x 4 pixels that a work-item merges: enough for the few samples of each to fill
// sixteen lanes where a work-item is a thread's, one where work-items run side by side.
std::uint32_t packets_of_item(const Kit& kit) {
    return kit.lanes == 1 ? 1 : 32;
}

std::uint64_t merge_items(const Kit& kit) {
    const std::uint32_t span = 4 * packets_of_item(kit);
    return (std::uint64_t{kit.width} + span - 1) / span * ((std::uint64_t{kit.height} + 3) / 4);
}

} // namespace

frame::Stage extract_support(const FoveatedKit& kit) {
    frame::Stage stage;
    stage.name = "extract the support image and G-buffer";
    stage.reads = {"sampling masks", "list offsets", "sampled colour", "surface depth",
                   "surface geometric normal"};
    stage.writes = {kit.per_support("support image", 16), kit.per_support("support geometry", 16)};
    if (kit.can_move()) {
        stage.reads.push_back("surface triangle");
        stage.writes.push_back(kit.per_support("support triangle", 4));
    }
    stage.prepare = [kit, name = stage.name] {
        kit.grid->prepare(kit.kit);
        auto kernel = kit.kit.library.kernel(kernel::VariantKey("cache/support"), "extract_support",
                                             kit.kit.device);
        return [kit, name, kernel](frame::Run& run) mutable {
            const compute::Buffer none;
            const bool any = kit.can_move();
            kernel
                .set(run.params_buffer(), kit.grid->params_buffer, kit.grid->cell_columns,
                     kit.grid->cell_rows, run["sampling masks"], run["list offsets"],
                     run["sampled colour"], run["surface depth"], run["surface geometric normal"],
                     any ? run["surface triangle"] : none, run["support image"],
                     run["support geometry"], any ? run["support triangle"] : none)
                .launch(name, {kit.packets()}, {kGroup});
        };
    };
    return stage;
}

frame::Stage measure_lag(const FoveatedKit& kit) {
    frame::Stage stage;
    stage.name = "measure the history's lag";
    stage.reads = {"mesh vertices", "pixel keys", "history kept", "support image",
                   "support geometry"};
    stage.reads_last = {kit.image};
    stage.writes = {kit.per_support("history correction", 16)};
    stage.scratch = {kit.per_support("lag", 16)};
    stage.prepare = [kit, name = stage.name] {
        kit.grid->prepare(kit.kit);
        const kernel::VariantKey key("cache/lag");
        auto measure = kit.kit.library.kernel(key, "measure_lag", kit.kit.device);
        auto agree = kit.kit.library.kernel(key, "agree_on_lag", kit.kit.device);
        return [kit, name, measure, agree](frame::Run& run) mutable {
            const SupportGrid& grid = *kit.grid;
            const auto range = compute::Range::cover(grid.samples(), kGroup);
            measure
                .set(run.params_buffer(), grid.params_buffer, grid.columns, grid.rows,
                     grid.mesh_columns, grid.mesh_rows, run["mesh vertices"], run["pixel keys"],
                     run["history kept"], run.last(kit.image), run["support image"],
                     run["support geometry"], kit.moved(), run.scratch("lag"))
                .launch(name, {range}, {kGroup});
            agree.set(grid.params_buffer, run.scratch("lag"), run["history correction"])
                .launch(name, {range}, {kGroup});
        };
    };
    return stage;
}

frame::Stage find_change(const FoveatedKit& kit, std::uint32_t noise) {
    frame::Stage stage;
    stage.name = "find what changed";
    stage.reads = {"mesh vertices", "pixel keys",    "resampling info",
                   "history kept",  "support image", "support geometry"};
    stage.reads_last = {kit.image, "support change"};
    stage.writes = {kit.per_support("support change", 4)};
    stage.scratch = {kit.per_support("difference from the history", 4)};
    stage.prepare = [kit, noise, name = stage.name] {
        kit.grid->prepare(kit.kit);
        const auto key = kernel::VariantKey("cache/change").parameter("noise", noise);
        auto measure = kit.kit.library.kernel(key, "measure_change", kit.kit.device);
        auto find = kit.kit.library.kernel(key, "find_change", kit.kit.device);
        return [kit, name, measure, find](frame::Run& run) mutable {
            if (kit.moved() == 0) {
                run["support change"].fill(0);
                return;
            }
            const SupportGrid& grid = *kit.grid;
            const auto range = compute::Range::cover(grid.samples(), kGroup);
            const compute::Buffer difference = run.scratch("difference from the history");
            measure
                .set(run.params_buffer(), grid.params_buffer, grid.columns, grid.rows,
                     grid.mesh_columns, grid.mesh_rows, run["mesh vertices"], run["pixel keys"],
                     run["resampling info"], run["history kept"], run.last(kit.image),
                     run.last("support change"), run["support image"], run["support geometry"],
                     difference, run["support change"])
                .launch(name, {range}, {kGroup});
            find.set(grid.params_buffer, difference, run["support change"])
                .launch(name, {range}, {kGroup});
        };
    };
    return stage;
}

frame::Stage merge_cache(const FoveatedKit& kit, bool catch_up, const std::string& light,
                         std::uint32_t light_bytes) {
    frame::Stage stage;
    stage.name = "update and merge the cache";
    stage.reads = {"mesh vertices",  "mesh cells",     "pixel keys",
                   "history kept",   "sampling masks", "support image",
                   "sampled colour", "surface depth",  "list offsets"};
    if (catch_up)
        stage.reads.push_back("history correction");
    if (kit.can_move())
        stage.reads.push_back("support change");
    stage.reads_last = {kit.image, "cache info"};
    stage.writes = {per_pixel(kit.kit, kit.image, 16), per_pixel(kit.kit, "cache info", 8),
                    per_pixel(kit.kit, "reprojected colour", 16)};
    if (light_bytes != 0) {
        stage.reads.push_back("sampled light");
        stage.reads_last.push_back(light);
        stage.writes.push_back(per_pixel(kit.kit, light, light_bytes));
    }
    stage.prepare = [kit, catch_up, light, light_bytes, name = stage.name] {
        kit.grid->prepare(kit.kit);
        const auto key = kernel::VariantKey("cache/merge")
                             .parameter("light", light_bytes / 4)
                             .parameter("packets", packets_of_item(kit.kit));
        auto kernel = kit.kit.library.kernel(key, "merge_cache", kit.kit.device);
        const std::size_t group = kit.kit.lanes == 1 ? kGroup : 1;
        return [kit, catch_up, light, light_bytes, name, group, kernel](frame::Run& run) mutable {
            const compute::Buffer none;
            const bool lit = light_bytes != 0;
            const SupportGrid& grid = *kit.grid;
            kernel
                .set(run.params_buffer(), grid.params_buffer, grid.mesh_columns, grid.mesh_rows,
                     run["mesh vertices"], run["mesh cells"], run["pixel keys"],
                     run["history kept"], run["sampling masks"], run["list offsets"],
                     run.last(kit.image), run.last("cache info"), lit ? run.last(light) : none,
                     run["support image"], catch_up ? run["history correction"] : none,
                     kit.moved() != 0 ? run["support change"] : none, run["sampled colour"],
                     run["surface depth"], lit ? run["sampled light"] : none, run[kit.image],
                     run["cache info"], lit ? run[light] : none, run["reprojected colour"])
                .launch(name, {compute::Range::cover(merge_items(kit.kit), group)}, {group});
        };
    };
    return stage;
}

frame::Stage place_surfaces(const FoveatedKit& kit) {
    frame::Stage stage;
    stage.name = "place surfaces";
    stage.reads = {"mesh cells",     "pixel keys",     "history kept",
                   "sampling masks", "ray count",      "pixel of slot",
                   "surface depth",  "surface motion", "surface geometric normal"};
    stage.writes = {{"surface planes", 4 * MACULA_SURFACE_PLANES, kit.kit.pixels()},
                    per_pixel(kit.kit, "fresh pixels", 4)};
    stage.prepare = [kit, name = stage.name] {
        kit.grid->prepare(kit.kit);
        auto mesh = kit.kit.library.kernel(kernel::VariantKey("cache/surfaces"),
                                           "place_mesh_surfaces", kit.kit.device);
        auto samples = kit.kit.library.kernel(kernel::VariantKey("upscale/surfaces"),
                                              "place_surfaces", kit.kit.device);
        return [kit, name, mesh, samples](frame::Run& run) mutable {
            const SupportGrid& grid = *kit.grid;
            mesh.set(run.params_buffer(), grid.params_buffer, grid.mesh_columns, grid.mesh_rows,
                     run["mesh cells"], run["pixel keys"], run["history kept"],
                     run["sampling masks"], run["surface planes"], run["fresh pixels"])
                .launch(name, {kit.packets()}, {kGroup});
            samples
                .set(run.params_buffer(), run["ray count"], run["pixel of slot"],
                     run["surface depth"], run["surface motion"], run["surface geometric normal"],
                     compute::Buffer(), run["surface planes"], compute::Buffer())
                .launch(name, {kit.kit.slots()}, {kGroup});
        };
    };
    return stage;
}

} // namespace macula::stage
