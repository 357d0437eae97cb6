/// What an OpenCL device says about itself, as far as Macula cares.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace macula::compute {

enum class DeviceType { cpu, gpu, accelerator, other };

/// "cpu", "gpu", "accelerator" or "other".
const char* to_string(DeviceType type);

/// What the device promises of one floating-point width (CL_DEVICE_*_FP_CONFIG).
struct FloatFacts {
    bool supported = false;
    bool denormals = false;
    bool infinity_and_nan = false;
    bool round_to_nearest = false;
    bool round_to_zero = false;
    bool round_to_infinity = false;
    bool fma = false;
    /// Division and square root are correctly rounded when the build asks for it. fp32 only.
    bool correctly_rounded_divide_sqrt = false;
    bool emulated = false;
};

struct DeviceFacts {
    /// Position in enumerate(): what `--device N` takes.
    int index = 0;
    std::string platform_name, platform_vendor, platform_version;
    std::string name, vendor;
    /// e.g. "OpenCL 3.0 PoCL ...".
    std::string version;
    /// e.g. "OpenCL C 1.2 PoCL".
    std::string c_version;
    std::string driver_version;
    std::string extensions;
    DeviceType type = DeviceType::other;
    bool full_profile = false;
    bool available = false;
    bool compiler_available = false;
    bool little_endian = false;
    /// Host and device share memory, so that mapping a buffer copies nothing.
    bool unified_memory = false;
    /// Of the numeric version in `version`, e.g. 1 and 2.
    int major = 0, minor = 0;
    std::uint32_t compute_units = 0;
    std::uint32_t clock_mhz = 0;
    std::uint32_t address_bits = 0;
    std::uint32_t cache_line_bytes = 0;
    std::uint64_t global_cache_bytes = 0;
    std::uint64_t global_memory_bytes = 0;
    std::uint64_t max_allocation_bytes = 0;
    std::uint64_t max_constant_bytes = 0;
    std::uint64_t local_memory_bytes = 0;
    /// False when local memory is ordinary memory, as on CPUs.
    bool local_memory_dedicated = false;
    std::size_t max_work_group_size = 0;
    std::vector<std::size_t> max_work_item_sizes;
    std::uint32_t preferred_float_width = 0, native_float_width = 0;
    FloatFacts fp16, fp32, fp64;
    bool images = false;
    std::size_t max_image2d_width = 0, max_image2d_height = 0;
    /// ns per tick of profiling timestamps.
    std::size_t profiling_resolution_ns = 0;
};

struct PlatformFacts {
    std::string name, vendor, version;
    std::vector<DeviceFacts> devices;
};

/// All platforms with their devices, in the order of the ICD loader. Never throws: no loader
/// entry, an empty platform or one that fails to answer gives an empty list.
std::vector<PlatformFacts> platforms();

/// All devices of all platforms; device i has index i. Empty when there is none.
std::vector<DeviceFacts> enumerate();

/// The device that `selector` names: an index, "cpu", "gpu", or a part of the device's or
/// platform's name (case does not matter; the first match in the list). Empty: the value of
/// MACULA_DEVICE, or else the first GPU, or else the first CPU, or else the first device.
/// Throws Error that lists the devices when none matches, or names the package to install when
/// there is none.
const DeviceFacts& select(const std::vector<DeviceFacts>& devices, const std::string& selector);

} // namespace macula::compute
