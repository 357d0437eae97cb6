#include "host/frame/resources.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace macula::frame {
namespace {

std::uint64_t bytes_of(const Resource& resource) {
    if (resource.element_bytes != 0 &&
        resource.count > std::numeric_limits<std::uint64_t>::max() / resource.element_bytes)
        throw std::invalid_argument("resource \"" + resource.name + "\" has an absurd size");
    return resource.count * resource.element_bytes;
}

} // namespace

Resources::Resources(compute::Device& device)
    : device_(device), params_(device.allocate(sizeof(shared::FrameParams), "frame parameters")) {}

void Resources::allocate(const Resource& resource) {
    compute::Buffer& buffer = storage_[resource.place()];
    if (!buffer)
        buffer = device_.allocate(bytes_of(resource), resource.place());
    else if (buffer.size() != bytes_of(resource))
        throw std::invalid_argument("resource \"" + resource.name + "\" and its storage \"" +
                                    resource.place() + "\" differ in size");
    current_[resource.name] = buffer;
}

void Resources::keep_history(const Resource& resource) {
    last_[resource.name] = device_.allocate(bytes_of(resource), "last frame's " + resource.name);
    clear_history();
}

void Resources::reserve_scratch(const Resource& resource) {
    std::uint64_t& bytes = scratch_bytes_[resource.name];
    bytes = std::max(bytes, bytes_of(resource));
}

void Resources::allocate_scratch() {
    for (const auto& [name, bytes] : scratch_bytes_)
        scratch_[name] = device_.allocate(bytes, name);
}

void Resources::set_params(const shared::FrameParams& params) {
    params_.write_one(params);
}

compute::Buffer& Resources::current(const std::string& name) {
    const auto found = current_.find(name);
    return found == current_.end() ? none_ : found->second;
}

compute::Buffer& Resources::last(const std::string& name) {
    const auto found = last_.find(name);
    return found == last_.end() ? none_ : found->second;
}

compute::Buffer& Resources::scratch(const std::string& name) {
    return scratch_.at(name);
}

void Resources::advance() {
    for (auto& [name, buffer] : last_)
        std::swap(buffer, current_[name]);
}

void Resources::clear_history() {
    first_frame_ = true;
    for (auto& [name, buffer] : last_)
        current_[name].fill(0); // advance() makes it the last frame's
}

} // namespace macula::frame
