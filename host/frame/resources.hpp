// The named device buffers of a method.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "host/cl/device.hpp"
#include "shared/camera.h"

namespace macula::frame {

struct Resource {
    std::string name;
    std::uint32_t element_bytes = 0;
    std::uint64_t count = 0;
    // The memory it lies in: resources with the same storage take turns in it, or are one buffer
    // that a stage changes in place. Empty: memory of its own, called as the resource.
    std::string storage = {};

    const std::string& place() const { return storage.empty() ? name : storage; }
};

class Resources {
  public:
    explicit Resources(compute::Device& device);

    // Throws std::invalid_argument where resources of one storage differ in size.
    void allocate(const Resource& resource);
    // Allocates a second buffer, filled with zeros, for the last frame's contents.
    void keep_history(const Resource& resource);
    // The largest of all requests of one name is allocated.
    void reserve_scratch(const Resource& resource);
    void allocate_scratch();

    void set_params(const shared::FrameParams& params);
    compute::Buffer& params() { return params_; }

    // Empty for what was not allocated.
    compute::Buffer& current(const std::string& name);
    compute::Buffer& last(const std::string& name);
    // Throws std::out_of_range for a name that was not reserved.
    compute::Buffer& scratch(const std::string& name);

    // The frame's contents become the last frame's.
    void advance();
    // Also at the beginning: the next frame is a first one.
    void clear_history();
    void end_first_frame() { first_frame_ = false; }
    bool first_frame() const { return first_frame_; }

  private:
    compute::Device& device_;
    bool first_frame_ = true;
    compute::Buffer params_, none_;
    std::map<std::string, compute::Buffer> current_, last_, scratch_, storage_;
    std::map<std::string, std::uint64_t> scratch_bytes_;
};

} // namespace macula::frame
