#include "bench/compare.hpp"

namespace macula::bench {
namespace {

void count(Agreement& agreement, Verdict verdict) {
    switch (verdict) {
    case Verdict::same:
        ++agreement.same;
        break;
    case Verdict::tie:
        ++agreement.ties;
        break;
    case Verdict::rounding:
        ++agreement.rounding;
        break;
    case Verdict::mismatch:
        ++agreement.mismatches;
        break;
    }
}

} // namespace

TestRay test_ray(const RaySet& rays, std::uint32_t ray) {
    return {rays.origin(ray), rays.direction(ray), rays.t_min(ray), rays.t_max(ray)};
}

Comparison::Comparison(const EmbreeScene& embree, compute::Device& device,
                       frame::DeviceGeometry& geometry, VariantRun& reference)
    : embree_(embree), device_(device), geometry_(geometry), reference_(reference),
      judge_(embree.scene()) {}

Surface Comparison::surface(std::uint32_t triangle_id) const {
    const frame::TriangleOrigin origin = geometry_.origin_of(triangle_id);
    return {origin.instance, origin.mesh, origin.triangle};
}

Agreement Comparison::compare(const RaySet& rays, const RayResults& ours,
                              const EmbreeRays& theirs) const {
    return is_any_hit(rays.ray_class) ? compare_any(rays, ours, theirs)
                                      : compare_closest(rays, ours, theirs);
}

Agreement Comparison::compare_closest(const RaySet& rays, const RayResults& ours,
                                      const EmbreeRays& theirs) const {
    Agreement agreement;
    for (std::uint32_t i = 0; i < rays.count; ++i) {
        const shared::HitBlock& block = ours.hits[i / MACULA_RAY_BLOCK];
        const std::uint32_t lane = i % MACULA_RAY_BLOCK;
        TestHit mine{block.t[lane], std::nullopt};
        if (block.triangle[lane] != MACULA_NO_TRIANGLE)
            mine.surface = surface(block.triangle[lane]);
        const EmbreeHit other = theirs.hit(i);
        count(agreement, judge_.closest(test_ray(rays, i), mine, {other.t, other.surface}));
    }
    return agreement;
}

// Flags alone do not say what was hit: where they differ, both sides are asked for the closest hit.
Agreement Comparison::compare_any(const RaySet& rays, const RayResults& ours,
                                  const EmbreeRays& theirs) const {
    Agreement agreement;
    RaySet disputed;
    disputed.ray_class = kernel::RayClass::random;
    for (std::uint32_t i = 0; i < rays.count; ++i) {
        if ((ours.occluded[i] != 0) == theirs.occluded(i))
            ++agreement.same;
        else
            disputed.append(rays.origin(i), rays.direction(i), rays.t_min(i), rays.t_max(i));
    }
    if (disputed.count == 0)
        return agreement;
    EmbreeRays embree_rays(embree_, disputed, EmbreeCall::single);
    embree_rays.run();
    DeviceRays device_rays(device_, disputed);
    reference_.run(device_rays);
    const Agreement why = compare_closest(disputed, device_rays.results(), embree_rays);
    // Where both find the same closest hit, one of them has an any-hit query that disagrees with
    // its own closest-hit query.
    agreement.rounding = why.rounding;
    agreement.mismatches = disputed.count - why.rounding;
    return agreement;
}

} // namespace macula::bench
