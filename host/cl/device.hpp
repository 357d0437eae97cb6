/// An open OpenCL device: one context and one in-order queue with profiling. All of Macula's device
/// work goes through here, in four steps:
///
///     compute::Device device = compute::open("");              // MACULA_DEVICE, or a GPU, or a
///     CPU kernel::Library library;                                  // embedded kernels + caches
///
///     // 1. Allocate. Sizes are checked first; `what` appears in error messages.
///     compute::Buffer rays = device.allocate_array<shared::RayBlock>(blocks, "primary rays");
///     compute::Buffer nodes = device.upload(std::span(node_vector), "BVH nodes");
///
///     // 2. Build (cached in the process and on disk). The key makes all -D flags.
///     compute::Kernel trace = library.kernel(
///         kernel::VariantKey("traverse/wide8").any_hit(false).parameter("work_group", 64),
///         "trace", device);
///
///     // 3. Launch: arguments in the kernel's order, by value or as buffers; an empty Buffer is a
///     //    null pointer. `local` omitted: the driver chooses. Nothing blocks.
///     trace.set(nodes, rays, std::uint32_t(count)).launch("trace primary rays", {global}, {64});
///
///     // 4. Read results through a map, never a copy; the map waits for what was launched.
///     auto hits = results.map_read<shared::HitBlock>();         // hits[i], hits.size(), unmaps
///     for (const compute::Span& span : device.timeline().take())  // device clock, one per launch
///         print(span.stage, span.device_ns());
///
/// Handles (Device, Buffer, Kernel) are cheap to copy and share what they name. A device may be
/// used from one thread at a time; several devices may be open at once, each in its own thread.
#pragma once

#include "host/cl/buffer.hpp"
#include "host/cl/error.hpp"
#include "host/cl/facts.hpp"
#include "host/cl/kernel.hpp"
#include "host/cl/program.hpp"
#include "host/cl/timeline.hpp"

#include <limits>
#include <memory>
#include <span>
#include <string>

namespace macula::compute {

struct DeviceState;

class Device {
  public:
    explicit Device(std::shared_ptr<DeviceState> state);

    const DeviceFacts& facts() const&;
    /// Of a temporary: open("cpu").facts() must not dangle.
    DeviceFacts facts() &&;

    /// Uninitialised device memory; 0 bytes is allowed. Throws Error, before asking OpenCL, when
    /// `bytes` is beyond the device's largest allocation or what is left of its memory.
    Buffer allocate(std::uint64_t bytes, const std::string& what) const;

    /// `count` elements of T; the product is checked for overflow.
    template <class T>
    Buffer allocate_array(std::uint64_t count, const std::string& what) const {
        return allocate(bytes_of(count, sizeof(T), what), what);
    }

    /// A buffer with a copy of `values`.
    template <class T, std::size_t N>
    Buffer upload(std::span<T, N> values, const std::string& what) const {
        Buffer buffer = allocate(values.size_bytes(), what);
        buffer.write(values);
        return buffer;
    }

    /// Bytes allocated through this device and still alive.
    std::uint64_t allocated_bytes() const;

    /// Builds OpenCL C source; `what` names the program in errors. Throws BuildError. Everyone but
    /// kernel::Library calls kernel::Library instead.
    Program build(const std::string& source, const std::string& options,
                  const std::string& what) const;
    /// Builds from Program::binary() of the same device and driver.
    Program load(std::span<const std::byte> binary, const std::string& options,
                 const std::string& what) const;

    /// Starts the work that was launched, without waiting for it.
    void flush() const;
    /// Waits for all launched work. Throws Error when a launch failed or the device was lost.
    void finish() const;

    Timeline& timeline() const;

    /// Equal for handles of the same open device.
    const void* id() const { return state_.get(); }

  private:
    static std::uint64_t bytes_of(std::uint64_t count, std::size_t size, const std::string& what);

    std::shared_ptr<DeviceState> state_;
};

/// Opens the device that `selector` names (see select()). Each call makes a context and queue of
/// its own. Throws Error when none matches or when the device cannot run Macula (OpenCL 1.2, full
/// profile, a compiler, little-endian).
Device open(const std::string& selector = "");

} // namespace macula::compute
