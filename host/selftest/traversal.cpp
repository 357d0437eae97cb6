#include "host/selftest/selftest.hpp"

#include "bvh/ray_blocks.hpp"
#include "host/frame/geometry.hpp"
#include "host/selftest/scene.hpp"
#include "host/stage/trace.hpp"

#include <bit>

#include <fmt/format.h>

namespace macula::selftest {
namespace {

using kernel::RayClass;

bool same(const shared::HitBlock& block, std::size_t lane, const shared::TraceHit& hit) {
    const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
    return block.triangle[lane] == hit.triangle && bits(block.t[lane]) == bits(hit.t) &&
           (hit.triangle == MACULA_NO_TRIANGLE ||
            (bits(block.u[lane]) == bits(hit.u) && bits(block.v[lane]) == bits(hit.v)));
}

// The rays of one class on the device with the answers of the CPU reference.
struct Bundle {
    RayClass ray_class;
    std::vector<bvh::Ray> rays;
    std::vector<shared::TraceHit> hits;
    std::vector<bool> occluded;
    compute::Buffer blocks, count;
    std::uint32_t capacity = 0;
};

Bundle make_bundle(const compute::Device& device, const bvh::ReferenceScene& reference,
                   RayClass ray_class, std::vector<bvh::Ray> rays) {
    Bundle bundle{ray_class, std::move(rays), {}, {}, {}, {}, 0};
    for (const bvh::Ray& ray : bundle.rays) {
        bundle.hits.push_back(bvh::closest(ray, reference));
        bundle.occluded.push_back(bvh::occluded(ray, reference));
    }
    const std::vector<shared::RayBlock> blocks = bvh::blocks_of(bundle.rays, bundle.rays.size());
    const std::uint32_t count = static_cast<std::uint32_t>(bundle.rays.size());
    bundle.capacity = static_cast<std::uint32_t>(blocks.size() * 16);
    bundle.blocks = device.upload(std::span(blocks), "self-test rays");
    bundle.count = device.upload(std::span(&count, 1), "self-test ray count");
    return bundle;
}

std::uint32_t closest_mismatches(const compute::Device& device, stage::Tracer& tracer,
                                 const Bundle& bundle) {
    auto hits = device.allocate_array<shared::HitBlock>(bundle.capacity / 16, "self-test hits");
    tracer.closest(bundle.ray_class, bundle.blocks, bundle.count, bundle.capacity, hits,
                   "self-test closest");
    const auto found = hits.map_read<shared::HitBlock>();
    std::uint32_t wrong = 0;
    for (std::size_t i = 0; i < bundle.rays.size(); ++i)
        wrong += same(found[i / 16], i % 16, bundle.hits[i]) ? 0 : 1;
    return wrong;
}

std::uint32_t any_mismatches(const compute::Device& device, stage::Tracer& tracer,
                             const Bundle& bundle) {
    auto occluded = device.allocate_array<std::uint32_t>(bundle.capacity, "self-test occlusion");
    tracer.any(bundle.ray_class, bundle.blocks, bundle.count, bundle.capacity, occluded,
               "self-test any");
    const auto found = occluded.map_read<std::uint32_t>();
    std::uint32_t wrong = 0;
    for (std::size_t i = 0; i < bundle.rays.size(); ++i)
        wrong += (found[i] != 0) == bundle.occluded[i] ? 0 : 1;
    return wrong;
}

Outcome check_variant(compute::Device& device, frame::DeviceGeometry& geometry,
                      const kernel::Variant& variant, std::span<const Bundle> bundles) {
    Outcome outcome{fmt::format("traversal {}", variant.name), true, ""};
    std::size_t compared = 0;
    try {
        stage::VariantTable table;
        table.fill({&variant, {}});
        stage::Tracer tracer(device, geometry, table);
        for (const Bundle& bundle : bundles) {
            const std::string reason =
                kernel::why_not(variant, kernel::traits_of(device), bundle.ray_class);
            if (!reason.empty())
                continue;
            const std::uint32_t closest = closest_mismatches(device, tracer, bundle);
            const std::uint32_t any = any_mismatches(device, tracer, bundle);
            compared += 2 * bundle.rays.size();
            if (closest + any != 0) {
                outcome.passed = false;
                outcome.detail +=
                    fmt::format("{} of {} closest and {} any {} rays differ; ", closest,
                                bundle.rays.size(), any, name(bundle.ray_class));
            }
        }
    } catch (const std::exception& error) {
        return {outcome.check, false, error.what()};
    }
    if (outcome.passed && compared == 0)
        outcome.detail = "does not apply here";
    else if (outcome.passed)
        outcome.detail = fmt::format("{} rays equal the CPU reference", compared);
    return outcome;
}

} // namespace

std::vector<Outcome> check_traversal(const compute::Device& device, kernel::Library& /*library*/) {
    compute::Device handle = device;
    frame::DeviceGeometry geometry(handle, make_scene(), {});
    const bvh::ReferenceScene reference = geometry.reference();
    std::vector<Bundle> bundles;
    bundles.push_back(make_bundle(device, reference, RayClass::primary, coherent_rays()));
    bundles.push_back(make_bundle(device, reference, RayClass::random, incoherent_rays()));
    std::vector<Outcome> outcomes;
    for (const kernel::Variant& variant : kernel::variants())
        outcomes.push_back(check_variant(handle, geometry, variant, bundles));
    return outcomes;
}

} // namespace macula::selftest
