#include "host/cl/device.hpp"

#include "host/cl/huge_pages.hpp"
#include "host/cl/state.hpp"

#include <algorithm>
#include <utility>

namespace macula::compute {
namespace {

// For a new buffer of a CPU device: the memory is the process's own.
void back_by_huge_pages(const DeviceState& device, const cl::Buffer& buffer, std::uint64_t bytes) {
    void* const data =
        device.queue.enqueueMapBuffer(buffer, CL_TRUE, CL_MAP_WRITE_INVALIDATE_REGION, 0, bytes);
    prefer_huge_pages(data, bytes);
    device.queue.enqueueUnmapMemObject(buffer, data);
}

void require_usable(const DeviceFacts& facts) {
    const std::string who = "device \"" + facts.name + "\" cannot run Macula: ";
    if (facts.major < 1 || (facts.major == 1 && facts.minor < 2))
        throw Error(who + "it has \"" + facts.version + "\", and OpenCL 1.2 is needed");
    if (!facts.full_profile)
        throw Error(who + "it has the embedded profile, whose arithmetic is not exact enough");
    if (!facts.available)
        throw Error(who + "its driver says that it is not available");
    if (!facts.compiler_available)
        throw Error(who + "its driver has no OpenCL C compiler");
    if (!facts.little_endian)
        throw Error(who + "it is big-endian");
}

std::string megabytes(std::uint64_t bytes) {
    if (bytes < 1000000)
        return std::to_string(bytes) + " bytes";
    return std::to_string(bytes / 1000000) + " MB";
}

[[noreturn]] void refuse(std::uint64_t bytes, const std::string& what, const DeviceState& device,
                         const std::string& reason) {
    throw Error("cannot allocate " + megabytes(bytes) + " for \"" + what + "\" on " +
                device.name() + ": " + reason);
}

void require_room(std::uint64_t bytes, const std::string& what, const DeviceState& device) {
    const DeviceFacts& facts = device.facts;
    if (bytes > facts.max_allocation_bytes)
        refuse(bytes, what, device,
               "its largest single allocation is " + megabytes(facts.max_allocation_bytes));
    const std::uint64_t free =
        facts.global_memory_bytes - std::min(facts.global_memory_bytes, device.allocated);
    if (bytes > free)
        refuse(bytes, what, device,
               "it has " + megabytes(facts.global_memory_bytes) + " of memory, of which " +
                   megabytes(device.allocated) + " are in use here");
}

} // namespace

Device open(const std::string& selector) {
    std::vector<FoundDevice> found = find_devices();
    std::vector<DeviceFacts> facts;
    facts.reserve(found.size());
    for (const FoundDevice& device : found)
        facts.push_back(device.facts);
    const DeviceFacts& chosen = select(facts, selector);
    require_usable(chosen);
    auto state = std::make_shared<DeviceState>();
    state->facts = chosen;
    state->device = found[static_cast<std::size_t>(chosen.index)].device;
    try {
        state->context = cl::Context(state->device);
        state->queue = cl::CommandQueue(state->context, state->device, CL_QUEUE_PROFILING_ENABLE);
    } catch (const cl::Error& e) {
        throw Error("cannot open " + state->name(), e.err());
    }
    return Device(std::move(state));
}

Device::Device(std::shared_ptr<DeviceState> state) : state_(std::move(state)) {}

const DeviceFacts& Device::facts() const& {
    return state_->facts;
}

DeviceFacts Device::facts() && {
    return state_->facts;
}

std::uint64_t Device::allocated_bytes() const {
    return state_->allocated;
}

Timeline& Device::timeline() const {
    return state_->timeline;
}

std::uint64_t Device::bytes_of(std::uint64_t count, std::size_t size, const std::string& what) {
    if (count > std::numeric_limits<std::uint64_t>::max() / size)
        throw Error("cannot allocate " + std::to_string(count) + " elements of " +
                    std::to_string(size) + " bytes for \"" + what + "\": the size overflows");
    return count * size;
}

Buffer Device::allocate(std::uint64_t bytes, const std::string& what) const {
    require_room(bytes, what, *state_);
    // OpenCL has no empty buffers; kernels never read one, since its count is 0.
    constexpr std::uint64_t kLeast = 16;
    // On a device with its own memory this flag would keep the buffer on the host's side.
    const cl_mem_flags place = state_->facts.unified_memory ? CL_MEM_ALLOC_HOST_PTR : 0;
    auto buffer = std::make_shared<BufferState>();
    try {
        buffer->buffer =
            cl::Buffer(state_->context, CL_MEM_READ_WRITE | place, std::max(bytes, kLeast));
        if (state_->facts.type == DeviceType::cpu && bytes >= kLeastHugeBytes)
            back_by_huge_pages(*state_, buffer->buffer, bytes);
    } catch (const cl::Error& e) {
        throw Error("cannot allocate " + megabytes(bytes) + " for \"" + what + "\" on " +
                        state_->name() + ", which has " +
                        megabytes(state_->facts.global_memory_bytes) + " with " +
                        megabytes(state_->allocated) + " in use here",
                    e.err());
    }
    buffer->size = bytes;
    buffer->what = what;
    buffer->device = state_;
    state_->allocated += bytes;
    return Buffer(std::move(buffer));
}

void Device::flush() const {
    try {
        state_->queue.flush();
    } catch (const cl::Error& e) {
        throw Error("cannot start the work queued on " + state_->name(), e.err());
    }
}

void Device::finish() const {
    try {
        state_->queue.finish();
    } catch (const cl::Error& e) {
        throw Error("waiting for " + state_->name(), e.err());
    }
    state_->timeline.collect();
}

} // namespace macula::compute
