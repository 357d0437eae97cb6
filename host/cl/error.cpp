#include "host/cl/error.hpp"

#define CL_TARGET_OPENCL_VERSION 300
#include <CL/cl.h>

#include <array>
#include <utility>

namespace macula::compute {
namespace {

struct StatusName {
    int status;
    const char* name;
};

#define MACULA_STATUS(name)                                                                        \
    StatusName {                                                                                   \
        name, #name                                                                                \
    }
constexpr std::array kStatusNames{
    MACULA_STATUS(CL_DEVICE_NOT_FOUND),
    MACULA_STATUS(CL_DEVICE_NOT_AVAILABLE),
    MACULA_STATUS(CL_COMPILER_NOT_AVAILABLE),
    MACULA_STATUS(CL_MEM_OBJECT_ALLOCATION_FAILURE),
    MACULA_STATUS(CL_OUT_OF_RESOURCES),
    MACULA_STATUS(CL_OUT_OF_HOST_MEMORY),
    MACULA_STATUS(CL_PROFILING_INFO_NOT_AVAILABLE),
    MACULA_STATUS(CL_MEM_COPY_OVERLAP),
    MACULA_STATUS(CL_BUILD_PROGRAM_FAILURE),
    MACULA_STATUS(CL_MAP_FAILURE),
    MACULA_STATUS(CL_MISALIGNED_SUB_BUFFER_OFFSET),
    MACULA_STATUS(CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST),
    MACULA_STATUS(CL_COMPILE_PROGRAM_FAILURE),
    MACULA_STATUS(CL_LINKER_NOT_AVAILABLE),
    MACULA_STATUS(CL_LINK_PROGRAM_FAILURE),
    MACULA_STATUS(CL_KERNEL_ARG_INFO_NOT_AVAILABLE),
    MACULA_STATUS(CL_INVALID_VALUE),
    MACULA_STATUS(CL_INVALID_PLATFORM),
    MACULA_STATUS(CL_INVALID_DEVICE),
    MACULA_STATUS(CL_INVALID_CONTEXT),
    MACULA_STATUS(CL_INVALID_QUEUE_PROPERTIES),
    MACULA_STATUS(CL_INVALID_COMMAND_QUEUE),
    MACULA_STATUS(CL_INVALID_HOST_PTR),
    MACULA_STATUS(CL_INVALID_MEM_OBJECT),
    MACULA_STATUS(CL_INVALID_BINARY),
    MACULA_STATUS(CL_INVALID_BUILD_OPTIONS),
    MACULA_STATUS(CL_INVALID_PROGRAM),
    MACULA_STATUS(CL_INVALID_PROGRAM_EXECUTABLE),
    MACULA_STATUS(CL_INVALID_KERNEL_NAME),
    MACULA_STATUS(CL_INVALID_KERNEL_DEFINITION),
    MACULA_STATUS(CL_INVALID_KERNEL),
    MACULA_STATUS(CL_INVALID_ARG_INDEX),
    MACULA_STATUS(CL_INVALID_ARG_VALUE),
    MACULA_STATUS(CL_INVALID_ARG_SIZE),
    MACULA_STATUS(CL_INVALID_KERNEL_ARGS),
    MACULA_STATUS(CL_INVALID_WORK_DIMENSION),
    MACULA_STATUS(CL_INVALID_WORK_GROUP_SIZE),
    MACULA_STATUS(CL_INVALID_WORK_ITEM_SIZE),
    MACULA_STATUS(CL_INVALID_GLOBAL_OFFSET),
    MACULA_STATUS(CL_INVALID_EVENT_WAIT_LIST),
    MACULA_STATUS(CL_INVALID_EVENT),
    MACULA_STATUS(CL_INVALID_OPERATION),
    MACULA_STATUS(CL_INVALID_BUFFER_SIZE),
    MACULA_STATUS(CL_INVALID_GLOBAL_WORK_SIZE),
    MACULA_STATUS(CL_INVALID_PROPERTY),
    MACULA_STATUS(CL_INVALID_COMPILER_OPTIONS),
    MACULA_STATUS(CL_INVALID_LINKER_OPTIONS),
};
#undef MACULA_STATUS

/// cl_khr_icd: the loader found no platform. Its header is not always installed.
constexpr int kPlatformNotFound = -1001;

std::string with_advice(const std::string& doing, int status) {
    std::string message = doing + ": " + status_name(status);
    const std::string advice = status_advice(status);
    return advice.empty() ? message : message + " (" + advice + ")";
}

} // namespace

std::string status_name(int status) {
    if (status == kPlatformNotFound)
        return "CL_PLATFORM_NOT_FOUND_KHR";
    for (const StatusName& entry : kStatusNames)
        if (entry.status == status)
            return entry.name;
    return "CL error " + std::to_string(status);
}

std::string status_advice(int status) {
    switch (status) {
    case kPlatformNotFound:
        return "no OpenCL platform: install one, e.g. the Debian package pocl-opencl-icd for the "
               "CPU";
    case CL_DEVICE_NOT_AVAILABLE:
    case CL_INVALID_COMMAND_QUEUE:
    case CL_INVALID_CONTEXT:
        return "the device was lost: its driver reset it or took it away; start again, and look "
               "for "
               "the driver's message in the system log";
    case CL_OUT_OF_RESOURCES:
        return "the device ran out of resources or stopped the kernel: use a smaller image or "
               "work-group, or look for a driver time limit in the system log";
    case CL_MEM_OBJECT_ALLOCATION_FAILURE:
        return "the device is out of memory: use a smaller scene or image, or close other programs "
               "that use the device";
    case CL_OUT_OF_HOST_MEMORY:
        return "the machine is out of memory: use a smaller scene or image";
    case CL_COMPILER_NOT_AVAILABLE:
        return "the driver has no OpenCL C compiler: choose another device";
    default:
        return {};
    }
}

Error::Error(const std::string& doing, int status)
    : std::runtime_error(with_advice(doing, status)), status_(status) {}

BuildError::BuildError(const std::string& what, const std::string& device, std::string log,
                       int status)
    : Error("cannot build " + what + " on " + device + ", compiler log:\n" + log, status),
      log_(std::move(log)) {}

} // namespace macula::compute
