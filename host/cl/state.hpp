/// Internal to host/cl: the OpenCL objects behind the handles. The only header that includes
/// opencl.hpp; included by host/cl/*.cpp alone.
#pragma once

#define CL_HPP_TARGET_OPENCL_VERSION 300
#define CL_HPP_MINIMUM_OPENCL_VERSION 110
#define CL_HPP_ENABLE_EXCEPTIONS
#define CL_HPP_CL_1_2_DEFAULT_BUILD
#include <CL/opencl.hpp>

#include "host/cl/error.hpp"
#include "host/cl/facts.hpp"
#include "host/cl/timeline.hpp"

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace macula::compute {

struct DeviceState {
    cl::Device device;
    cl::Context context;
    cl::CommandQueue queue;
    DeviceFacts facts;
    Timeline timeline;
    std::uint64_t allocated = 0;

    /// The device in messages.
    std::string name() const { return "device \"" + facts.name + "\""; }
};

struct BufferState {
    std::shared_ptr<DeviceState> device;
    cl::Buffer buffer;
    std::uint64_t size = 0;
    std::string what;

    BufferState() = default;
    BufferState(const BufferState&) = delete;
    BufferState& operator=(const BufferState&) = delete;
    ~BufferState() {
        if (device)
            device->allocated -= size;
    }
    std::string name() const { return "buffer \"" + what + "\" on " + device->name(); }
};

struct ProgramState {
    std::shared_ptr<DeviceState> device;
    cl::Program program;
    std::string what;
};

struct KernelState {
    std::shared_ptr<DeviceState> device;
    cl::Kernel kernel;
    std::string name;
    /// Of the program, e.g. "traverse/wide8 [any_hit=0]".
    std::string program;
    std::size_t argument_count = 0;
    /// Keeps argument buffers alive: OpenCL itself does not.
    std::vector<std::shared_ptr<BufferState>> buffers;

    std::string full_name() const {
        return "kernel \"" + name + "\" of " + program + " on " + device->name();
    }
};

struct TimelineState {
    struct Launch {
        std::string stage;
        cl::Event event;
        std::uint64_t host_ns;
    };
    std::deque<Launch> pending;
    std::deque<Span> done;

    void add(Launch launch);
    void collect();
};

/// A device and its facts.
struct FoundDevice {
    cl::Device device;
    DeviceFacts facts;
};

/// All devices in the order of enumerate().
std::vector<FoundDevice> find_devices();

} // namespace macula::compute
