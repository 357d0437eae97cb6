// The trace stage: every ray of a frame goes through here. It launches the variant chosen for the
// ray class by the contract of kernels/lib/trace_contract.h; nothing returns to the host.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "host/kernel/variants.hpp"

namespace macula::compute {
class Device;
class Buffer;
} // namespace macula::compute
namespace macula::frame {
class DeviceGeometry;
}
namespace macula::kernel {
class Library;
}

namespace macula::stage {

// One variant for each ray class.
using VariantTable = std::array<kernel::Choice, kernel::kRayClasses.size()>;

// The registry's defaults, overridden by the tuning file of the user's cache directory, overridden
// by `forced` (the name given by --variant; empty: none), which also runs where the registry says
// that it does not apply. What is wrong with the tuning file goes to `warnings`, unless null.
// Throws std::invalid_argument when `forced` is unknown.
VariantTable choose_variants(const compute::Device& device, std::string_view forced = {},
                             std::vector<std::string>* warnings = nullptr);

class Tracer {
  public:
    // All references must outlive the tracer. Programs are built at first use; without a library
    // the tracer has one of its own. Throws std::invalid_argument for a choice without a variant
    // or with parameters out of range.
    Tracer(const compute::Device& device, frame::DeviceGeometry& geometry, VariantTable variants);
    Tracer(const compute::Device& device, kernel::Library& library, frame::DeviceGeometry& geometry,
           VariantTable variants);
    ~Tracer();
    Tracer(const Tracer&) = delete;
    Tracer& operator=(const Tracer&) = delete;

    // rays: RayBlocks for `capacity` rays; ray_count: one uint on the device, <= capacity; hits:
    // HitBlocks for `capacity` rays, written up to the count. Enqueued on the device's queue after
    // what was enqueued before, and timed under `launch_name` ("primary rays").
    void closest(kernel::RayClass ray_class, const compute::Buffer& rays,
                 const compute::Buffer& ray_count, std::uint32_t capacity, compute::Buffer& hits,
                 std::string_view launch_name);
    // occluded: one uint for each of `capacity` rays, 1 = something is hit.
    void any(kernel::RayClass ray_class, const compute::Buffer& rays,
             const compute::Buffer& ray_count, std::uint32_t capacity, compute::Buffer& occluded,
             std::string_view launch_name);

    const kernel::Choice& choice(kernel::RayClass ray_class) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace macula::stage
