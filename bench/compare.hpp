// Counts where a device's results and Embree's part ways.
#pragma once

#include <cstdint>

#include "bench/device_rays.hpp"
#include "bench/embree_rays.hpp"
#include "bench/judge.hpp"

namespace macula::bench {

struct Agreement {
    std::uint32_t same = 0, ties = 0, rounding = 0, mismatches = 0;
};

class Comparison {
  public:
    // `reference` traces the closest hits that tell why flags of any-hit rays differ. All must
    // outlive the comparison.
    Comparison(const EmbreeScene& embree, compute::Device& device, frame::DeviceGeometry& geometry,
               VariantRun& reference);

    // `theirs` must have run on the same rays.
    Agreement compare(const RaySet& rays, const RayResults& ours, const EmbreeRays& theirs) const;

    // Of the device's triangle id.
    Surface surface(std::uint32_t triangle_id) const;

  private:
    Agreement compare_closest(const RaySet& rays, const RayResults& ours,
                              const EmbreeRays& theirs) const;
    Agreement compare_any(const RaySet& rays, const RayResults& ours,
                          const EmbreeRays& theirs) const;

    const EmbreeScene& embree_;
    compute::Device& device_;
    frame::DeviceGeometry& geometry_;
    VariantRun& reference_;
    Judge judge_;
};

// Hits of a set as TestHits; the id of a miss is MACULA_NO_TRIANGLE.
TestRay test_ray(const RaySet& rays, std::uint32_t ray);

} // namespace macula::bench
