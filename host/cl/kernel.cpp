#include "host/cl/kernel.hpp"

#include "host/cl/state.hpp"

#include <chrono>
#include <utility>

namespace macula::compute {
namespace {

using Clock = std::chrono::steady_clock;

std::string to_text(Range range) {
    return std::to_string(range.x) + " x " + std::to_string(range.y) + " x " +
           std::to_string(range.z);
}

cl::NDRange nd_range(Range range) {
    return cl::NDRange(range.x, range.y, range.z);
}

void require_multiple(const KernelState& kernel, Range global, Range local) {
    const bool empty = local.x == 0 || local.y == 0 || local.z == 0;
    if (empty || global.x % local.x || global.y % local.y || global.z % local.z)
        throw Error("launching " + kernel.full_name() + ": the global size " + to_text(global) +
                    " is no multiple of the work-group " + to_text(local));
}

void launch_kernel(KernelState& kernel, const std::string& stage, Range global,
                   const cl::NDRange& local) {
    TimelineState::Launch launch{stage, {}, 0};
    const auto start = Clock::now();
    try {
        kernel.device->queue.enqueueNDRangeKernel(kernel.kernel, cl::NullRange, nd_range(global),
                                                  local, nullptr, &launch.event);
    } catch (const cl::Error& e) {
        throw Error("launching stage \"" + stage + "\", " + kernel.full_name() + ", global size " +
                        to_text(global),
                    e.err());
    }
    const auto took = Clock::now() - start;
    launch.host_ns = static_cast<std::uint64_t>(
        std::chrono::duration_cast<std::chrono::nanoseconds>(took).count());
    kernel.device->timeline.state().add(std::move(launch));
}

} // namespace

Kernel::Kernel(std::shared_ptr<KernelState> state) : state_(std::move(state)) {}

const std::string& Kernel::name() const {
    return state_->name;
}

void Kernel::begin(std::size_t arguments) {
    if (!state_)
        throw Error("setting arguments of a kernel that was never built");
    if (arguments != state_->argument_count)
        throw Error(state_->full_name() + " takes " + std::to_string(state_->argument_count) +
                    " arguments and was given " + std::to_string(arguments));
}

void Kernel::set_bytes(std::size_t position, const void* value, std::size_t bytes) {
    const cl_int status =
        clSetKernelArg(state_->kernel(), static_cast<cl_uint>(position), bytes, value);
    if (status != CL_SUCCESS)
        throw Error("setting argument " + std::to_string(position) + " (" + std::to_string(bytes) +
                        " bytes) of " + state_->full_name(),
                    status);
}

void Kernel::set_one(std::size_t position, const Buffer& buffer) {
    const cl_mem memory = buffer ? buffer.state()->buffer() : nullptr;
    if (buffer && buffer.state()->device != state_->device)
        throw Error("argument " + std::to_string(position) + " of " + state_->full_name() +
                    " is the " + buffer.state()->name() + ", which belongs to another open device");
    set_bytes(position, &memory, sizeof(cl_mem));
    state_->buffers.at(position) = buffer.state();
}

void Kernel::set_one(std::size_t position, LocalMemory local) {
    set_bytes(position, nullptr, local.bytes);
}

void Kernel::launch(const std::string& stage, Range global, Range local) const {
    if (!state_)
        throw Error("launching stage \"" + stage + "\" with a kernel that was never built");
    require_multiple(*state_, global, local);
    if (global.x && global.y && global.z)
        launch_kernel(*state_, stage, global, nd_range(local));
}

void Kernel::launch(const std::string& stage, Range global) const {
    if (!state_)
        throw Error("launching stage \"" + stage + "\" with a kernel that was never built");
    if (global.x && global.y && global.z)
        launch_kernel(*state_, stage, global, cl::NullRange);
}

std::size_t Kernel::max_work_group_size() const {
    std::size_t size = 0;
    const cl_int status =
        clGetKernelWorkGroupInfo(state_->kernel(), state_->device->device(),
                                 CL_KERNEL_WORK_GROUP_SIZE, sizeof size, &size, nullptr);
    if (status != CL_SUCCESS)
        throw Error("asking the work-group size of " + state_->full_name(), status);
    return size;
}

std::size_t Kernel::preferred_multiple() const {
    std::size_t size = 0;
    const cl_int status = clGetKernelWorkGroupInfo(state_->kernel(), state_->device->device(),
                                                   CL_KERNEL_PREFERRED_WORK_GROUP_SIZE_MULTIPLE,
                                                   sizeof size, &size, nullptr);
    if (status != CL_SUCCESS)
        throw Error("asking the work-group multiple of " + state_->full_name(), status);
    return size;
}

} // namespace macula::compute
