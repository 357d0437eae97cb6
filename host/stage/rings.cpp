#include "host/stage/rings.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "host/kernel/prefix_sum.hpp"
#include "lib/rings.h"
#include "shared/ray.h"

namespace macula::stage {
namespace {

constexpr const char* kGenerate = "generate/rings";

// Blocks of a width along an axis that touch the picture's pixels first <= x < end.
std::uint64_t blocks_along(int first, int end, std::uint32_t pixels, int width) {
    const int from = std::max(first, 0) / width;
    const int to = (std::min(end, static_cast<int>(pixels)) + width - 1) / width;
    return static_cast<std::uint64_t>(std::max(to - from, 0));
}

frame::Resource of_packets(const RingKit& kit, const char* name) {
    return {name, 4, kit.packets()};
}

} // namespace

shared::RingParams make_params(const RingOptions& options) {
    shared::RingParams params{};
    float least = 0.0f;
    for (std::size_t k = 0; k < options.edges.size(); ++k) {
        const float edge = options.edges[k];
        if (!(edge >= least && edge <= 180.0f))
            throw std::invalid_argument(
                fmt::format("method lowres_rings: the rings' edges must ascend from 0 to 180 "
                            "degrees; edge {} is {}",
                            k + 1, edge));
        params.degrees[k] = least = edge;
    }
    params.blur = options.blur ? 1 : 0;
    params.grid = options.grid ? 1 : 0;
    return params;
}

std::uint64_t count_blocks(const shared::FrameParams& frame, const shared::RingParams& params) {
    shared::Rings rings{};
    shared::place_rings_of(&frame, &params, &rings);
    const auto within = [&](std::size_t k, int width) {
        return blocks_along(rings.left[k], rings.right[k], frame.width, width) *
               blocks_along(rings.top[k], rings.bottom[k], frame.height, width);
    };
    // All blocks of the widest kind, and at each edge those within it by smaller ones.
    std::uint64_t count = blocks_along(0, static_cast<int>(frame.width), frame.width, 8) *
                          blocks_along(0, static_cast<int>(frame.height), frame.height, 8);
    for (std::size_t k = MACULA_RING_EDGES; k-- > 0;)
        count += within(k, 1 << k) - within(k, 2 << k);
    return count;
}

RingKit::RingKit(const Kit& all, const RingOptions& options)
    : kit(all), params(make_params(options)),
      used_slots(std::make_shared<std::uint32_t>(all.slots())) {
    kit.used_slots = used_slots;
}

std::uint32_t RingKit::packets() const {
    return kit.slots() / MACULA_RAY_BLOCK;
}

frame::Stage place_rings(const RingKit& kit) {
    frame::Stage stage;
    stage.name = "place the rings";
    stage.writes = {{"rings", sizeof(shared::Rings), 1}};
    stage.prepare = [kit, name = stage.name] {
        const compute::Buffer params =
            kit.kit.device.upload(std::span(&kit.params, 1), "parameters of the method");
        auto kernel =
            kit.kit.library.kernel(kernel::VariantKey(kGenerate), "place_rings", kit.kit.device);
        return [kit, params, name, kernel](frame::Run& run) mutable {
            // As many as the device will list: both compute the same edges.
            const std::uint64_t groups =
                (count_blocks(run.params(), kit.params) + kGroup - 1) / kGroup;
            *kit.used_slots =
                static_cast<std::uint32_t>(std::max<std::uint64_t>(groups, 1) * kGroup);
            kernel.set(run.params_buffer(), params, run["rings"]).launch(name, {1}, {1});
        };
    };
    return stage;
}

frame::Stage choose_blocks(const RingKit& kit) {
    frame::Stage stage;
    stage.name = "choose blocks";
    stage.reads = {"rings"};
    stage.writes = {
        of_packets(kit, "sampling masks"), of_packets(kit, "list offsets"), {"list length", 4, 1}};
    stage.prepare = [kit, name = stage.name] {
        auto choose =
            kit.kit.library.kernel(kernel::VariantKey(kGenerate), "choose_blocks", kit.kit.device);
        auto sum =
            std::make_shared<kernel::PrefixSum>(kit.kit.library, kit.kit.device, kit.packets());
        const std::uint32_t packets = kit.packets();
        const compute::Buffer count =
            kit.kit.device.upload(std::span(&packets, 1), "number of packets");
        return [kit, name, choose, sum, count](frame::Run& run) mutable {
            // The counts become their own offsets.
            choose
                .set(run.params_buffer(), run["rings"], run["sampling masks"], run["list offsets"])
                .launch(name, {kit.packets()}, {kGroup});
            sum->exclusive(run["list offsets"], count, run["list offsets"], run["list length"],
                           "order the list");
        };
    };
    return stage;
}

frame::Stage block_rays(const RingKit& kit) {
    frame::Stage stage;
    stage.name = "generate block rays";
    stage.reads = {"rings", "sampling masks", "list offsets", "list length"};
    stage.writes = {
        {"primary rays", sizeof(shared::RayBlock), kit.packets()},
        per_slot(kit.kit, "pixel of slot", 4),
        per_slot(kit.kit, "spread of slot", 4),
        {"ray count", 4, 1},
    };
    stage.prepare = [kit, name = stage.name] {
        auto kernel = kit.kit.library.kernel(kernel::VariantKey(kGenerate), "generate_block_rays",
                                             kit.kit.device);
        return [kit, name, kernel](frame::Run& run) mutable {
            kernel
                .set(run.params_buffer(), run["rings"], run.sample(), run["sampling masks"],
                     run["list offsets"], run["list length"], run["primary rays"],
                     run["pixel of slot"], run["spread of slot"], run["ray count"],
                     kit.kit.ray_totals, static_cast<std::uint32_t>(kernel::RayClass::sparse))
                .launch(name, {kit.packets()}, {kGroup});
        };
    };
    return stage;
}

frame::Stage show_rings(const RingKit& kit) {
    frame::Stage stage;
    stage.name = "blur the rings";
    stage.reads = {"rings", "block colour"};
    stage.writes = {per_pixel(kit.kit, "colour", 16)};
    stage.prepare = [kit, name = stage.name] {
        const compute::Buffer params =
            kit.kit.device.upload(std::span(&kit.params, 1), "parameters of the method");
        auto kernel = kit.kit.lane_kernel("remap/rings", "show_rings");
        return [kit, params, name, kernel](frame::Run& run) mutable {
            kernel
                .set(run.params_buffer(), params, run["rings"], run["block colour"], run["colour"])
                .launch(name, kit.kit.lane_items(kit.kit.slots()), kit.kit.lane_group());
        };
    };
    return stage;
}

} // namespace macula::stage
