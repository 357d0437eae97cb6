#include "host/cl/buffer.hpp"

#include "host/cl/state.hpp"

#include <utility>

namespace macula::compute {
namespace {

cl_map_flags flags_of(MapMode mode) {
    switch (mode) {
    case MapMode::read:
        return CL_MAP_READ;
    case MapMode::write:
        return CL_MAP_WRITE_INVALIDATE_REGION;
    case MapMode::update:
        break;
    }
    return CL_MAP_READ | CL_MAP_WRITE;
}

void require(const std::shared_ptr<BufferState>& state, const char* doing) {
    if (!state)
        throw Error(std::string(doing) + " a buffer that was never allocated");
}

void require_inside(const BufferState& buffer, std::uint64_t offset, std::uint64_t bytes) {
    if (offset > buffer.size || bytes > buffer.size - offset)
        throw Error("bytes " + std::to_string(offset) + " to " + std::to_string(offset + bytes) +
                    " are outside " + buffer.name() + ", which has " + std::to_string(buffer.size) +
                    " bytes");
}

} // namespace

RawMap::RawMap(std::shared_ptr<BufferState> buffer, MapMode mode, std::uint64_t offset,
               std::uint64_t bytes) {
    if (bytes == 0)
        return;
    try {
        data_ = static_cast<std::byte*>(buffer->device->queue.enqueueMapBuffer(
            buffer->buffer, CL_TRUE, flags_of(mode), offset, bytes));
    } catch (const cl::Error& e) {
        throw Error("mapping " + std::to_string(bytes) + " bytes of " + buffer->name(), e.err());
    }
    buffer_ = std::move(buffer);
}

RawMap::~RawMap() {
    release();
}

RawMap::RawMap(RawMap&& other) noexcept
    : buffer_(std::move(other.buffer_)), data_(std::exchange(other.data_, nullptr)) {}

RawMap& RawMap::operator=(RawMap&& other) noexcept {
    if (this != &other) {
        release();
        buffer_ = std::move(other.buffer_);
        data_ = std::exchange(other.data_, nullptr);
    }
    return *this;
}

void RawMap::release() noexcept {
    // A failure here means a lost device, which the next call on it reports.
    if (data_)
        clEnqueueUnmapMemObject(buffer_->device->queue(), buffer_->buffer(), data_, 0, nullptr,
                                nullptr);
    data_ = nullptr;
}

Buffer::Buffer(std::shared_ptr<BufferState> state) : state_(std::move(state)) {}

std::uint64_t Buffer::size() const {
    return state_ ? state_->size : 0;
}

const std::string& Buffer::what() const {
    require(state_, "asking the name of");
    return state_->what;
}

std::uint64_t Buffer::range(std::uint64_t first, std::uint64_t count, std::size_t size) const {
    require(state_, "mapping");
    const std::uint64_t all = state_->size / size;
    if (first > all || (count != kRest && count > all - first))
        throw Error("elements from " + std::to_string(first) + " on, " + std::to_string(count) +
                    " of " + std::to_string(size) + " bytes, are outside " + state_->name() +
                    ", which has " + std::to_string(all));
    return count == kRest ? all - first : count;
}

void Buffer::write_bytes(std::span<const std::byte> bytes, std::uint64_t offset) {
    require(state_, "writing to");
    require_inside(*state_, offset, bytes.size());
    if (bytes.empty())
        return;
    try {
        state_->device->queue.enqueueWriteBuffer(state_->buffer, CL_TRUE, offset, bytes.size(),
                                                 bytes.data());
    } catch (const cl::Error& e) {
        throw Error("writing " + std::to_string(bytes.size()) + " bytes to " + state_->name(),
                    e.err());
    }
}

void Buffer::fill(std::uint32_t word) {
    require(state_, "filling");
    const std::uint64_t bytes = state_->size / sizeof word * sizeof word;
    if (bytes == 0)
        return;
    try {
        state_->device->queue.enqueueFillBuffer(state_->buffer, word, 0, bytes);
    } catch (const cl::Error& e) {
        throw Error("filling " + state_->name(), e.err());
    }
}

void Buffer::copy_from(const Buffer& source, std::uint64_t bytes) {
    require(state_, "copying to");
    require(source.state_, "copying from");
    require_inside(*state_, 0, bytes);
    require_inside(*source.state_, 0, bytes);
    if (bytes == 0)
        return;
    try {
        state_->device->queue.enqueueCopyBuffer(source.state_->buffer, state_->buffer, 0, 0, bytes);
    } catch (const cl::Error& e) {
        throw Error("copying " + source.state_->name() + " to " + state_->name(), e.err());
    }
}

} // namespace macula::compute
