#include "host/cl/program.hpp"

#include "host/cl/device.hpp"
#include "host/cl/state.hpp"

#include <utility>

namespace macula::compute {
namespace {

std::string build_log(const DeviceState& device, const cl::Program& program) {
    try {
        return program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device.device);
    } catch (const cl::Error&) {
        return "(the driver gave no log)";
    }
}

/// The C call: cl::Program::build() throws away the log of some drivers.
void build_program(const DeviceState& device, const cl::Program& program,
                   const std::string& options, const std::string& what) {
    const cl_device_id id = device.device();
    const cl_int status = clBuildProgram(program(), 1, &id, options.c_str(), nullptr, nullptr);
    if (status != CL_SUCCESS)
        throw BuildError(what, device.name(), build_log(device, program), status);
}

} // namespace

Program Device::build(const std::string& source, const std::string& options,
                      const std::string& what) const {
    auto state = std::make_shared<ProgramState>();
    state->device = state_;
    state->what = what;
    try {
        state->program = cl::Program(state_->context, source);
    } catch (const cl::Error& e) {
        throw Error("creating " + what + " on " + state_->name(), e.err());
    }
    build_program(*state_, state->program, options, what);
    return Program(std::move(state));
}

Program Device::load(std::span<const std::byte> binary, const std::string& options,
                     const std::string& what) const {
    auto state = std::make_shared<ProgramState>();
    state->device = state_;
    state->what = what;
    try {
        const auto* bytes = reinterpret_cast<const unsigned char*>(binary.data());
        const cl::Program::Binaries binaries{{bytes, bytes + binary.size()}};
        state->program = cl::Program(state_->context, {state_->device}, binaries);
    } catch (const cl::Error& e) {
        throw Error("loading the binary of " + what + " on " + state_->name(), e.err());
    }
    build_program(*state_, state->program, options, what);
    return Program(std::move(state));
}

Program::Program(std::shared_ptr<ProgramState> state) : state_(std::move(state)) {}

std::string Program::log() const {
    return build_log(*state_->device, state_->program);
}

std::vector<std::byte> Program::binary() const {
    std::size_t size = 0;
    const cl_program program = state_->program();
    if (clGetProgramInfo(program, CL_PROGRAM_BINARY_SIZES, sizeof size, &size, nullptr) !=
            CL_SUCCESS ||
        size == 0)
        return {};
    std::vector<std::byte> bytes(size);
    std::byte* pointer = bytes.data();
    if (clGetProgramInfo(program, CL_PROGRAM_BINARIES, sizeof pointer, static_cast<void*>(&pointer),
                         nullptr) != CL_SUCCESS)
        return {};
    return bytes;
}

Kernel Program::kernel(const std::string& entry) const {
    auto kernel = std::make_shared<KernelState>();
    kernel->device = state_->device;
    kernel->name = entry;
    kernel->program = state_->what;
    try {
        kernel->kernel = cl::Kernel(state_->program, entry.c_str());
        kernel->argument_count = kernel->kernel.getInfo<CL_KERNEL_NUM_ARGS>();
    } catch (const cl::Error& e) {
        std::string names;
        try {
            names = state_->program.getInfo<CL_PROGRAM_KERNEL_NAMES>();
        } catch (const cl::Error&) {
            names = "unknown";
        }
        throw Error("creating " + kernel->full_name() + ", whose kernels are: " + names, e.err());
    }
    kernel->buffers.resize(kernel->argument_count);
    return Kernel(std::move(kernel));
}

} // namespace macula::compute
