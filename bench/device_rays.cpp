#include "bench/device_rays.hpp"

#include <algorithm>
#include <bit>

namespace macula::bench {
namespace {

constexpr std::uint32_t kLanes = MACULA_RAY_BLOCK;
constexpr shared::uint kUnwritten = 0xa5a5a5a5u;
// A prefix that takes less than this says little: it may be all launch overhead.
constexpr double kTellingSeconds = 0.05;
constexpr std::uint32_t kFirstPrefix = 64; // rays

stage::VariantTable table_of(const kernel::Choice& choice) {
    stage::VariantTable table;
    table.fill(choice);
    return table;
}

std::string decimal(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

} // namespace

std::uint32_t RayResults::differences(const RayResults& a, const RayResults& b,
                                      std::uint32_t count) {
    std::uint32_t different = 0;
    const auto same = [](float x, float y) {
        return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
    };
    for (std::uint32_t i = 0; i < count; ++i) {
        if (!a.occluded.empty()) {
            different += a.occluded[i] != b.occluded[i] ? 1 : 0;
            continue;
        }
        const shared::HitBlock &x = a.hits[i / kLanes], &y = b.hits[i / kLanes];
        const std::uint32_t l = i % kLanes;
        const bool equal = same(x.t[l], y.t[l]) && same(x.u[l], y.u[l]) && same(x.v[l], y.v[l]) &&
                           x.triangle[l] == y.triangle[l];
        different += equal ? 0 : 1;
    }
    return different;
}

DeviceRays::DeviceRays(compute::Device& device, const RaySet& rays) : rays_(&rays) {
    blocks = device.upload(std::span(rays.blocks), "rays of the benchmark");
    count = device.upload(std::span<const std::uint32_t>(&rays.count, 1), "number of rays");
    const std::uint64_t lanes = rays.blocks.size() * kLanes;
    output = is_any_hit(rays.ray_class)
                 ? device.allocate_array<shared::uint>(lanes, "occlusion of the benchmark's rays")
                 : device.allocate_array<shared::HitBlock>(rays.blocks.size(),
                                                           "hits of the benchmark's rays");
}

RayResults DeviceRays::results() const {
    RayResults results;
    if (is_any_hit(rays_->ray_class)) {
        const auto mapped = output.map_read<shared::uint>();
        results.occluded.assign(mapped.begin(), mapped.end());
    } else {
        const auto mapped = output.map_read<shared::HitBlock>();
        results.hits.assign(mapped.begin(), mapped.end());
    }
    return results;
}

void DeviceRays::clear_results() {
    output.fill(kUnwritten);
}

VariantRun::VariantRun(compute::Device& device, frame::DeviceGeometry& geometry,
                       kernel::Choice choice)
    : device_(device), choice_(std::move(choice)), tracer_(device, geometry, table_of(choice_)) {}

RunTime VariantRun::run(DeviceRays& rays, std::optional<std::uint32_t> prefix) {
    const kernel::RayClass ray_class = rays.rays().ray_class;
    const std::uint32_t capacity = prefix.value_or(rays.rays().count);
    if (prefix)
        rays.count.write_one(capacity);
    device_.finish();
    device_.timeline().take();
    const Stopwatch watch;
    if (is_any_hit(ray_class))
        tracer_.any(ray_class, rays.blocks, rays.count, capacity, rays.output, "bench");
    else
        tracer_.closest(ray_class, rays.blocks, rays.count, capacity, rays.output, "bench");
    device_.finish();
    RunTime time = watch.elapsed();
    for (const compute::Span& span : device_.timeline().take())
        time.device += static_cast<double>(span.device_ns()) * 1e-9;
    if (prefix)
        rays.count.write_one(rays.rays().count);
    return time;
}

std::optional<std::string> VariantRun::warm_up(DeviceRays& rays, std::uint32_t runs,
                                               double limit_seconds) {
    const std::uint32_t count = rays.rays().count;
    const auto too_slow = [&](double seconds, std::uint32_t prefix) -> std::optional<std::string> {
        const double foretold = seconds * count / prefix * runs;
        if (foretold <= limit_seconds)
            return std::nullopt;
        return "its first " + std::to_string(prefix) + " rays foretell " + decimal(foretold) +
               " s for all rounds, beyond the limit of " + decimal(limit_seconds) + " s";
    };
    // On an untried driver the other variants are still worth their figures.
    try {
        run(rays, std::min(count, kFirstPrefix));
    } catch (const compute::BuildError& error) {
        return std::string(error.what());
    }
    for (std::uint32_t prefix = kFirstPrefix; prefix < count; prefix *= 16) {
        run(rays, prefix);
        const double seconds = run(rays, prefix).wall;
        if (seconds < kTellingSeconds)
            continue;
        if (auto reason = too_slow(seconds, prefix))
            return reason;
    }
    run(rays);
    return too_slow(run(rays).wall, count);
}

} // namespace macula::bench
