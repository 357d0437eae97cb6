#include "host/stage/log_polar.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "host/kernel/prefix_sum.hpp"
#include "lib/camera.h"
#include "shared/ray.h"

namespace macula::stage {
namespace {

constexpr const char* kGenerate = "generate/log_polar";

void require(bool holds, const char* what) {
    if (!holds)
        throw std::invalid_argument(std::string("method logpolar: ") + what);
}

void check(const LogPolarOptions& o) {
    require(o.alpha >= 1.0f && o.alpha <= 16.0f, "alpha must be 1 to 16");
    require(o.rect_alpha >= 1.0f && o.rect_alpha <= 16.0f, "alpha of logrect must be 1 to 16");
    require(o.sigma >= 1.0f && o.sigma <= 16.0f, "sigma must be 1 to 16");
    require(o.disk >= 0.0f && o.disk <= 10.0f, "the disk's radius must be 0 to 10 half diagonals");
    require(o.disk_degrees >= 0.0f && o.disk_degrees < 80.0f,
            "the disk's radius must be 0 to 80 degrees");
    require(o.fade >= 0.0f && o.fade <= 1.0f, "the disk's fade must be 0 to 1");
}

// Not more than are rendered: the list has a slot for each pixel.
std::uint32_t texels(std::uint32_t rendered, std::uint32_t picture, float sigma) {
    const auto wanted =
        static_cast<std::uint32_t>(std::lround((picture != 0 ? picture : rendered) / sigma));
    return std::max(std::min(wanted, rendered), 4u);
}

frame::Resource mask_of_packets(const LogPolarKit& kit, const char* name) {
    return {name, 4, kit.packets()};
}

// What a table of the buffer's columns and rows is for (kernels/generate/log_polar.cl).
constexpr std::uint32_t kOfMiddles = 0, kOfRays = 1;

std::uint32_t axis_entries(const LogPolarKit& kit) {
    return kit.buffer->params().width + kit.buffer->params().height;
}

compute::Range axis_range(const LogPolarKit& kit) {
    return {compute::Range::cover(axis_entries(kit), kGroup)};
}

} // namespace

const char* name(LodRule rule) {
    return rule == LodRule::thesis ? "thesis" : "footprint";
}

LodRule parse_lod_rule(std::string_view text) {
    for (const LodRule rule : {LodRule::footprint, LodRule::thesis})
        if (text == name(rule))
            return rule;
    throw std::invalid_argument("--lod \"" + std::string(text) +
                                "\": footprint or thesis was expected");
}

shared::LogPolarParams make_params(const LogPolarOptions& o, std::uint32_t width,
                                   std::uint32_t height, std::uint32_t picture_width,
                                   std::uint32_t picture_height) {
    check(o);
    shared::LogPolarParams p{};
    p.width = texels(width, picture_width, o.sigma);
    p.height = texels(height, picture_height, o.sigma);
    p.alpha = o.alpha;
    p.inverse_alpha = 1.0f / o.alpha;
    p.disk = o.disk;
    p.disk_tangent = std::tan(o.disk_degrees * std::numbers::pi_v<float> / 180.0f);
    p.fade = o.fade;
    // Section 4.1.2: what is foveated is not sharpened before it is enlarged.
    p.spread_scale = picture_width != 0 ? static_cast<float>(picture_width) / width : 1.0f;
    p.thesis_lod = o.lod == LodRule::thesis ? 1 : 0;
    p.pitch = p.width + 2;
    p.capacity = shared::slot_count(width, height);
    return p;
}

void LogPolarBuffer::prepare(const Kit& kit) {
    if (!params_buffer)
        params_buffer = kit.device.upload(std::span(&params_, 1), "parameters of the method");
}

std::uint32_t LogPolarKit::disk_packets() const {
    return kit.slots() / MACULA_RAY_BLOCK;
}

std::uint32_t LogPolarKit::packets() const {
    const shared::LogPolarParams& p = buffer->params();
    return disk_packets() + shared::slot_count(p.width, p.height) / MACULA_RAY_BLOCK;
}

kernel::VariantKey LogPolarKit::program(const char* name) const {
    return kernel::VariantKey(name).parameter("rectangular", rectangular ? 1 : 0);
}

frame::Stage place_fovea(const LogPolarKit& kit) {
    frame::Stage stage;
    stage.name = "place the fovea";
    stage.writes = {{"fovea", sizeof(shared::Fovea), 1}};
    stage.prepare = [kit, name = stage.name] {
        kit.buffer->prepare(kit.kit);
        auto kernel = kit.kit.library.kernel(kit.program(kGenerate), "place_fovea", kit.kit.device);
        return [kit, name, kernel](frame::Run& run) mutable {
            kernel.set(run.params_buffer(), kit.buffer->params_buffer, run["fovea"])
                .launch(name, {1}, {1});
        };
    };
    return stage;
}

frame::Stage choose_samples(const LogPolarKit& kit) {
    frame::Stage stage;
    stage.name = "choose samples";
    stage.reads = {"fovea"};
    stage.writes = {mask_of_packets(kit, "sampling masks"),
                    mask_of_packets(kit, "list offsets"),
                    {"list length", 4, 1},
                    {"log-polar colour", 16, kit.buffer->texels()}};
    stage.scratch = {{"texel axes", 16, axis_entries(kit)}};
    stage.prepare = [kit, name = stage.name] {
        kit.buffer->prepare(kit.kit);
        auto tabulate =
            kit.kit.library.kernel(kit.program(kGenerate), "tabulate_texels", kit.kit.device);
        auto choose =
            kit.kit.library.kernel(kit.program(kGenerate), "choose_samples", kit.kit.device);
        auto sum =
            std::make_shared<kernel::PrefixSum>(kit.kit.library, kit.kit.device, kit.packets());
        const std::uint32_t packets = kit.packets();
        const compute::Buffer count =
            kit.kit.device.upload(std::span(&packets, 1), "number of packets");
        return [=](frame::Run& run) mutable {
            compute::Buffer& axes = run.scratch("texel axes");
            tabulate
                .set(run.params_buffer(), kit.buffer->params_buffer, run["fovea"], 0u, kOfMiddles,
                     axes, run["log-polar colour"])
                .launch(name, axis_range(kit), {kGroup});
            // The counts become their own offsets.
            choose
                .set(run.params_buffer(), kit.buffer->params_buffer, run["fovea"],
                     kit.disk_packets(), axes, run["sampling masks"], run["list offsets"],
                     run["log-polar colour"])
                .launch(name, {kit.packets()}, {kGroup});
            sum->exclusive(run["list offsets"], count, run["list offsets"], run["list length"],
                           "order the list");
        };
    };
    return stage;
}

frame::Stage log_polar_rays(const LogPolarKit& kit) {
    frame::Stage stage;
    stage.name = "generate log-polar rays";
    stage.reads = {"fovea", "sampling masks", "list offsets", "list length", "log-polar colour"};
    stage.writes = {
        {"primary rays", sizeof(shared::RayBlock), kit.disk_packets()},
        per_slot(kit.kit, "pixel of slot", 4),
        per_slot(kit.kit, "spread of slot", 4),
        {"ray count", 4, 1},
    };
    stage.scratch = {{"texel axes", 16, axis_entries(kit)}};
    stage.prepare = [kit, name = stage.name] {
        auto tabulate =
            kit.kit.library.kernel(kit.program(kGenerate), "tabulate_texels", kit.kit.device);
        auto kernel = kit.kit.library.kernel(kit.program(kGenerate), "generate_log_polar_rays",
                                             kit.kit.device);
        return [=](frame::Run& run) mutable {
            compute::Buffer& axes = run.scratch("texel axes");
            tabulate
                .set(run.params_buffer(), kit.buffer->params_buffer, run["fovea"], run.sample(),
                     kOfRays, axes, run["log-polar colour"])
                .launch(name, axis_range(kit), {kGroup});
            kernel
                .set(run.params_buffer(), kit.buffer->params_buffer, run["fovea"],
                     kit.disk_packets(), run.sample(), axes, run["sampling masks"],
                     run["list offsets"], run["list length"], run["primary rays"],
                     run["pixel of slot"], run["spread of slot"], run["ray count"],
                     kit.kit.ray_totals, static_cast<std::uint32_t>(kernel::RayClass::sparse),
                     run["log-polar colour"])
                .launch(name, {kit.packets()}, {kGroup});
        };
    };
    return stage;
}

frame::Stage remap_log_polar(const LogPolarKit& kit) {
    frame::Stage stage;
    stage.name = "remap";
    stage.reads = {"fovea", "ray count", "pixel of slot", "sampled colour", "log-polar colour"};
    stage.writes = {per_pixel(kit.kit, "colour", 16)};
    stage.prepare = [kit, name = stage.name] {
        const auto key = [&kit](const char* program) {
            return kernel::VariantKey(program)
                .parameter("lanes", kit.kit.lanes)
                .parameter("smoothed", kit.smoothed ? 1 : 0);
        };
        kernel::Library& library = kit.kit.library;
        auto place = library.kernel(key("remap/log_polar"), "place_samples", kit.kit.device);
        auto remap =
            kit.rectangular
                ? library.kernel(key("remap/log_rect"), "remap_log_rect", kit.kit.device)
                : library.kernel(key("remap/log_polar"), "remap_log_polar", kit.kit.device);
        return [kit, name, place, remap](frame::Run& run) mutable {
            const compute::Buffer& texels = run["log-polar colour"];
            place
                .set(run.params_buffer(), run["ray count"], run["pixel of slot"],
                     run["sampled colour"], run["colour"], texels)
                .launch("place samples", {kit.kit.slots()}, {kGroup});
            remap
                .set(run.params_buffer(), kit.buffer->params_buffer, run["fovea"], texels,
                     run["colour"])
                .launch(name, kit.kit.strips(kit.kit.width, kit.kit.height), {kStripGroup});
        };
    };
    return stage;
}

} // namespace macula::stage
