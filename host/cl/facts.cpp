#include "host/cl/facts.hpp"

#include "host/cl/state.hpp"

#include <cstdio>

namespace macula::compute {
namespace {

DeviceType type_of(cl_device_type type) {
    if (type & CL_DEVICE_TYPE_GPU)
        return DeviceType::gpu;
    if (type & CL_DEVICE_TYPE_CPU)
        return DeviceType::cpu;
    return type & CL_DEVICE_TYPE_ACCELERATOR ? DeviceType::accelerator : DeviceType::other;
}

/// A property that some drivers do not know: its absence is a value, not an error.
template <cl_device_info kName, class T>
T get_or(const cl::Device& device, T absent) {
    try {
        return static_cast<T>(device.getInfo<kName>());
    } catch (const cl::Error&) {
        return absent;
    }
}

FloatFacts float_facts(cl_device_fp_config config) {
    FloatFacts f;
    f.supported = config != 0;
    f.denormals = config & CL_FP_DENORM;
    f.infinity_and_nan = config & CL_FP_INF_NAN;
    f.round_to_nearest = config & CL_FP_ROUND_TO_NEAREST;
    f.round_to_zero = config & CL_FP_ROUND_TO_ZERO;
    f.round_to_infinity = config & CL_FP_ROUND_TO_INF;
    f.fma = config & CL_FP_FMA;
    f.correctly_rounded_divide_sqrt = config & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT;
    f.emulated = config & CL_FP_SOFT_FLOAT;
    return f;
}

/// CL_DEVICE_HALF_FP_CONFIG and CL_DEVICE_DOUBLE_FP_CONFIG are errors without their extension.
FloatFacts optional_float_facts(const cl::Device& device, cl_device_info name) {
    cl_device_fp_config config = 0;
    const cl_int status = clGetDeviceInfo(device(), name, sizeof config, &config, nullptr);
    return float_facts(status == CL_SUCCESS ? config : 0);
}

void read_names(const cl::Device& device, DeviceFacts& f) {
    f.name = device.getInfo<CL_DEVICE_NAME>();
    f.vendor = device.getInfo<CL_DEVICE_VENDOR>();
    f.version = device.getInfo<CL_DEVICE_VERSION>();
    f.c_version = get_or<CL_DEVICE_OPENCL_C_VERSION>(device, std::string());
    f.driver_version = device.getInfo<CL_DRIVER_VERSION>();
    f.extensions = device.getInfo<CL_DEVICE_EXTENSIONS>();
    f.type = type_of(device.getInfo<CL_DEVICE_TYPE>());
    f.full_profile = device.getInfo<CL_DEVICE_PROFILE>() == "FULL_PROFILE";
    if (std::sscanf(f.version.c_str(), "OpenCL %d.%d", &f.major, &f.minor) != 2)
        f.major = f.minor = 0;
}

void read_memory(const cl::Device& device, DeviceFacts& f) {
    f.cache_line_bytes = get_or<CL_DEVICE_GLOBAL_MEM_CACHELINE_SIZE>(device, 0u);
    f.global_cache_bytes = get_or<CL_DEVICE_GLOBAL_MEM_CACHE_SIZE>(device, std::uint64_t{0});
    f.global_memory_bytes = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
    f.max_allocation_bytes = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
    f.max_constant_bytes = device.getInfo<CL_DEVICE_MAX_CONSTANT_BUFFER_SIZE>();
    f.local_memory_bytes = device.getInfo<CL_DEVICE_LOCAL_MEM_SIZE>();
    f.local_memory_dedicated = device.getInfo<CL_DEVICE_LOCAL_MEM_TYPE>() == CL_LOCAL;
    cl_bool unified = CL_FALSE;
    clGetDeviceInfo(device(), CL_DEVICE_HOST_UNIFIED_MEMORY, sizeof unified, &unified, nullptr);
    f.unified_memory = unified == CL_TRUE;
}

void read_execution(const cl::Device& device, DeviceFacts& f) {
    f.available = device.getInfo<CL_DEVICE_AVAILABLE>() == CL_TRUE;
    f.compiler_available = device.getInfo<CL_DEVICE_COMPILER_AVAILABLE>() == CL_TRUE;
    f.little_endian = device.getInfo<CL_DEVICE_ENDIAN_LITTLE>() == CL_TRUE;
    f.compute_units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    f.clock_mhz = get_or<CL_DEVICE_MAX_CLOCK_FREQUENCY>(device, 0u);
    f.address_bits = device.getInfo<CL_DEVICE_ADDRESS_BITS>();
    f.max_work_group_size = device.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
    for (const auto size : device.getInfo<CL_DEVICE_MAX_WORK_ITEM_SIZES>())
        f.max_work_item_sizes.push_back(size);
    f.preferred_float_width = get_or<CL_DEVICE_PREFERRED_VECTOR_WIDTH_FLOAT>(device, 0u);
    f.native_float_width = get_or<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>(device, 0u);
    f.profiling_resolution_ns =
        get_or<CL_DEVICE_PROFILING_TIMER_RESOLUTION>(device, std::size_t{0});
}

DeviceFacts read_facts(const cl::Device& device, const PlatformFacts& platform) {
    DeviceFacts f;
    f.platform_name = platform.name;
    f.platform_vendor = platform.vendor;
    f.platform_version = platform.version;
    read_names(device, f);
    read_memory(device, f);
    read_execution(device, f);
    f.fp16 = optional_float_facts(device, CL_DEVICE_HALF_FP_CONFIG);
    f.fp32 = float_facts(device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>());
    f.fp64 = optional_float_facts(device, CL_DEVICE_DOUBLE_FP_CONFIG);
    f.images = device.getInfo<CL_DEVICE_IMAGE_SUPPORT>() == CL_TRUE;
    if (f.images) {
        f.max_image2d_width = device.getInfo<CL_DEVICE_IMAGE2D_MAX_WIDTH>();
        f.max_image2d_height = device.getInfo<CL_DEVICE_IMAGE2D_MAX_HEIGHT>();
    }
    return f;
}

struct FoundPlatform {
    PlatformFacts facts;
    std::vector<FoundDevice> devices;
};

/// Devices of one platform. Drivers without hardware report "no device" as an error or as an empty
/// list; a device that fails to answer is left out.
std::vector<FoundDevice> devices_of(const cl::Platform& platform, const PlatformFacts& facts) {
    std::vector<cl::Device> devices;
    try {
        platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
    } catch (const cl::Error&) {
        return {};
    }
    std::vector<FoundDevice> found;
    for (const cl::Device& device : devices) {
        try {
            found.push_back({device, read_facts(device, facts)});
        } catch (const cl::Error&) {
            continue;
        }
    }
    return found;
}

std::vector<FoundPlatform> find_platforms() {
    std::vector<cl::Platform> list;
    try {
        cl::Platform::get(&list);
    } catch (const cl::Error&) {
        return {};
    }
    std::vector<FoundPlatform> found;
    int index = 0;
    for (const cl::Platform& platform : list) {
        try {
            FoundPlatform entry;
            entry.facts.name = platform.getInfo<CL_PLATFORM_NAME>();
            entry.facts.vendor = platform.getInfo<CL_PLATFORM_VENDOR>();
            entry.facts.version = platform.getInfo<CL_PLATFORM_VERSION>();
            entry.devices = devices_of(platform, entry.facts);
            for (FoundDevice& device : entry.devices)
                device.facts.index = index++;
            found.push_back(std::move(entry));
        } catch (const cl::Error&) {
            continue;
        }
    }
    return found;
}

} // namespace

const char* to_string(DeviceType type) {
    switch (type) {
    case DeviceType::cpu:
        return "cpu";
    case DeviceType::gpu:
        return "gpu";
    case DeviceType::accelerator:
        return "accelerator";
    case DeviceType::other:
        break;
    }
    return "other";
}

std::vector<FoundDevice> find_devices() {
    std::vector<FoundDevice> all;
    for (FoundPlatform& platform : find_platforms())
        for (FoundDevice& device : platform.devices)
            all.push_back(std::move(device));
    return all;
}

std::vector<PlatformFacts> platforms() {
    std::vector<PlatformFacts> all;
    for (FoundPlatform& platform : find_platforms()) {
        for (FoundDevice& device : platform.devices)
            platform.facts.devices.push_back(std::move(device.facts));
        all.push_back(std::move(platform.facts));
    }
    return all;
}

std::vector<DeviceFacts> enumerate() {
    std::vector<DeviceFacts> all;
    for (FoundDevice& device : find_devices())
        all.push_back(std::move(device.facts));
    return all;
}

} // namespace macula::compute
