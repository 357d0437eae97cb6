#include "host/stage/temporal.hpp"

#include <algorithm>

#include "shared/planes.h"
#include "shared/ray.h"

namespace macula::stage {
namespace {

compute::Range rendered_strips(const Kit& kit) {
    return kit.strips(kit.width, kit.height);
}

frame::Resource planes(const Kit& kit, const std::string& name, std::uint32_t count) {
    return {name, 4 * count, kit.pixels()};
}

// `texels`: where samples that belong to no pixel go; empty: there are none.
frame::Stage place(const Kit& kit, const frame::Resource& to, const std::string& texels) {
    frame::Stage stage;
    stage.name = "place surfaces";
    stage.reads = {"ray count", "pixel of slot", "surface depth", "surface motion",
                   "surface geometric normal"};
    if (!texels.empty())
        stage.reads.emplace_back("surface position");
    stage.writes = {to};
    stage.prepare = [kit, to, texels, name = stage.name] {
        auto kernel = kit.library.kernel(kernel::VariantKey("upscale/surfaces"), "place_surfaces",
                                         kit.device);
        return [=](frame::Run& run) mutable {
            if (run.sample() != 0)
                return;
            const compute::Buffer none;
            kernel
                .set(run.params_buffer(), run["ray count"], run["pixel of slot"],
                     run["surface depth"], run["surface motion"], run["surface geometric normal"],
                     texels.empty() ? none : run["surface position"], run[to.name],
                     texels.empty() ? none : run[texels])
                .launch(name, {kit.slots()}, {kGroup});
        };
    };
    return stage;
}

std::uint32_t beyond_disk(const TemporalKit& kit) {
    if (!kit.foveated)
        return MACULA_BEYOND_NOTHING;
    return kit.antialiased ? MACULA_BEYOND_SMOOTH : MACULA_BEYOND_GATHER;
}

std::string upscaled_from(const TemporalKit& kit) {
    return kit.antialiased ? "stable planes" : "colour planes";
}

} // namespace

frame::Stage place_surfaces(const Kit& kit) {
    return place(kit, planes(kit, "surface planes", MACULA_SURFACE_PLANES), "");
}

frame::Stage place_surfaces(const LogPolarKit& kit) {
    const std::string texels = "log-polar surface";
    frame::Stage stage =
        place(kit.kit, planes(kit.kit, "sampled surfaces", MACULA_SURFACE_PLANES), texels);
    stage.writes.push_back({texels, 16, kit.buffer->texels()});
    return stage;
}

frame::Stage remap_surfaces(const LogPolarKit& kit) {
    frame::Stage stage;
    stage.name = "remap surfaces";
    stage.reads = {"fovea", "sampled surfaces", "log-polar surface", "log-polar colour", "colour"};
    stage.reads_last = {"depth range"};
    stage.writes = {planes(kit.kit, "depth range", MACULA_RANGE_PLANES),
                    planes(kit.kit, "followed motion", 2), planes(kit.kit, "sample spread", 1)};
    stage.scratch = {{"texel ranges", 16, kit.buffer->texels()},
                     {"texel motions", 16, kit.buffer->texels()}};
    stage.prepare = [kit, name = stage.name] {
        kit.buffer->prepare(kit.kit);
        constexpr const char* program = "remap/log_polar_surface";
        const kernel::VariantKey key = kit.program(program).parameter("lanes", kit.kit.lanes);
        auto summarise = kit.kit.library.kernel(key, "summarise_texels", kit.kit.device);
        auto remap = kit.kit.library.kernel(key, "remap_surfaces", kit.kit.device);
        return [=](frame::Run& run) mutable {
            const shared::LogPolarParams& p = kit.buffer->params();
            summarise
                .set(kit.buffer->params_buffer, run["fovea"], run["log-polar colour"],
                     run["log-polar surface"], run.scratch("texel ranges"),
                     run.scratch("texel motions"))
                .launch("summarise texels", kit.kit.strips(p.width, p.height), {kStripGroup});
            remap
                .set(run.params_buffer(), kit.buffer->params_buffer, run["fovea"],
                     run.scratch("texel ranges"), run.scratch("texel motions"),
                     run["sampled surfaces"], run.last("depth range"), run["depth range"],
                     run["followed motion"], run["sample spread"])
                .launch(name, rendered_strips(kit.kit), {kStripGroup});
        };
    };
    return stage;
}

frame::Stage follow_surfaces(const TemporalKit& kit) {
    frame::Stage stage;
    stage.name = "follow surfaces";
    stage.reads = {"surface planes"};
    stage.reads_last = {"depth range"};
    stage.writes = {planes(kit.kit, "depth range", MACULA_RANGE_PLANES),
                    planes(kit.kit, "followed motion", 2)};
    stage.prepare = [kit, name = stage.name] {
        auto kernel = kit.kit.lane_kernel("upscale/follow", "follow_surfaces");
        return [=](frame::Run& run) mutable {
            kernel
                .set(run.params_buffer(), run["surface planes"], run.last("depth range"),
                     run["depth range"], run["followed motion"])
                .launch(name, rendered_strips(kit.kit), {kStripGroup});
        };
    };
    return stage;
}

frame::Stage antialias(const TemporalKit& kit) {
    frame::Stage stage;
    stage.name = "smooth over frames";
    stage.reads = {"colour", "sample spread", "followed motion", "fovea"};
    stage.reads_last = {"stable planes"};
    stage.writes = {planes(kit.kit, "stable planes", MACULA_COLOUR_PLANES),
                    per_pixel(kit.kit, "stable colour", 16)};
    stage.prepare = [kit, name = stage.name] {
        auto kernel = kit.kit.lane_kernel("upscale/antialias", "antialias");
        return [=](frame::Run& run) mutable {
            const compute::Buffer none;
            kernel
                .set(run.params_buffer(), kit.frame_rate, kit.upscaled ? run["fovea"] : none,
                     run["colour"], run["sample spread"], run["followed motion"],
                     run.last("stable planes"), run["stable planes"], run["stable colour"])
                .launch(name, rendered_strips(kit.kit), {kStripGroup});
        };
    };
    return stage;
}

frame::Stage split_colour(const TemporalKit& kit) {
    frame::Stage stage;
    stage.name = "split colour";
    stage.reads = {"colour"};
    stage.writes = {planes(kit.kit, "colour planes", kit.foveated ? 4 : 3)};
    stage.prepare = [kit, name = stage.name] {
        auto kernel = kit.kit.lane_kernel("upscale/antialias", "split_colour");
        return [=](frame::Run& run) mutable {
            kernel
                .set(kit.kit.width, kit.kit.height, kit.foveated ? 1u : 0u, run["colour"],
                     run["colour planes"])
                .launch(name, rendered_strips(kit.kit), {kStripGroup});
        };
    };
    return stage;
}

frame::Stage upscale(const TemporalKit& kit) {
    const std::uint32_t width = kit.kit.picture_width(), height = kit.kit.picture_height();
    const std::uint64_t pixels = std::uint64_t{width} * height;
    frame::Stage stage;
    stage.name = "upscale";
    stage.reads = {upscaled_from(kit), "followed motion"};
    stage.reads_last = {"upscaled planes"};
    if (kit.cached)
        stage.reads.emplace_back("fresh pixels");
    if (kit.foveated) {
        stage.reads.insert(stage.reads.end(), {"fovea", "sample spread"});
        stage.reads_last.emplace_back("fovea");
    }
    stage.writes = {{"upscaled planes", 4 * MACULA_UPSCALED_PLANES, pixels},
                    {"upscaled colour", 16, pixels}};
    stage.scratch = {planes(kit.kit, "thin features", 2)};
    stage.prepare = [=, name = stage.name] {
        auto upscale = kit.kit.lane_kernel("upscale/upscale", "upscale");
        auto find_thin = kit.kit.lane_kernel("upscale/locks", "find_thin");
        auto enlarge = kit.kit.lane_kernel("upscale/enlarge", "enlarge");
        auto sharpen = kit.kit.lane_kernel("upscale/sharpen", "sharpen");
        // What is as large as before needs no sharpening.
        const float ratio = static_cast<float>(width) / static_cast<float>(kit.kit.width);
        const float strength = kit.sharpness * std::min(ratio - 1.0f, 1.0f);
        const compute::Range range = kit.kit.strips(width, height);
        const compute::Range blocks =
            kit.kit.strips(width, (height + MACULA_ENLARGED_ROWS - 1) / MACULA_ENLARGED_ROWS);
        return [=](frame::Run& run) mutable {
            const compute::Buffer none;
            const compute::Buffer& colours = run[upscaled_from(kit)];
            const compute::Buffer fovea = kit.foveated ? run["fovea"] : none;
            const bool disk_alone = beyond_disk(kit) == MACULA_BEYOND_SMOOTH;
            find_thin
                .set(kit.kit.width, kit.kit.height, width, height, disk_alone ? fovea : none,
                     colours, run["followed motion"], run.scratch("thin features"))
                .launch("upscale: thin features", rendered_strips(kit.kit), {kStripGroup});
            upscale
                .set(run.params_buffer(), width, height, beyond_disk(kit), fovea,
                     kit.foveated ? run.last("fovea") : none, colours,
                     kit.foveated ? run["sample spread"] : none, run.scratch("thin features"),
                     run["followed motion"], run.last("upscaled planes"),
                     kit.cached ? run["fresh pixels"] : none, run["upscaled planes"])
                .launch(name, range, {kStripGroup});
            if (beyond_disk(kit) == MACULA_BEYOND_SMOOTH)
                enlarge.set(run.params_buffer(), width, height, colours, run["upscaled colour"])
                    .launch("upscale beyond the disk", blocks, {kStripGroup});
            sharpen
                .set(run.params_buffer(), width, height, beyond_disk(kit), strength, fovea,
                     run["upscaled planes"], run["upscaled colour"])
                .launch("sharpen", range, {kStripGroup});
        };
    };
    return stage;
}

} // namespace macula::stage
