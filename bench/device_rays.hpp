// The rays of a set on a device, and one traversal variant on them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/rays.hpp"
#include "bench/run_time.hpp"
#include "host/cl/device.hpp"
#include "host/frame/geometry.hpp"
#include "host/stage/trace.hpp"

namespace macula::bench {

// Results of a ray set, on the host: hits of closest-hit classes, flags of any-hit ones.
struct RayResults {
    std::vector<shared::HitBlock> hits;
    std::vector<shared::uint> occluded;

    // Rays whose results differ in any bit.
    static std::uint32_t differences(const RayResults& a, const RayResults& b, std::uint32_t count);
};

// Buffers that all variants share.
class DeviceRays {
  public:
    DeviceRays(compute::Device& device, const RaySet& rays);

    const RaySet& rays() const { return *rays_; }
    RayResults results() const;
    // The results' bits are set to what no ray gives, so that one left unwritten is seen.
    void clear_results();

    compute::Buffer blocks, count, output;

  private:
    const RaySet* rays_;
};

class VariantRun {
  public:
    // All references must outlive this object.
    VariantRun(compute::Device& device, frame::DeviceGeometry& geometry, kernel::Choice choice);

    // Enqueues the query of the set's class and waits. `prefix`: only the first so many rays.
    RunTime run(DeviceRays& rays, std::optional<std::uint32_t> prefix = std::nullopt);

    // Runs growing prefixes and then all, each twice (the first launch may compile). Gives the
    // reason, a sentence without a full stop, when the kernel does not build on this device, and
    // as soon as `runs` runs of all rays would take longer than `limit_seconds`; else nothing.
    std::optional<std::string> warm_up(DeviceRays& rays, std::uint32_t runs, double limit_seconds);

    const kernel::Choice& choice() const { return choice_; }

  private:
    compute::Device& device_;
    kernel::Choice choice_;
    stage::Tracer tracer_;
};

} // namespace macula::bench
