/// When each launch ran on the device, by the device's own clock (OpenCL profiling events).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace macula::compute {

/// One launch. Device times are nanoseconds of the device's clock, comparable within one device;
/// some drivers (rusticl) report dummy values.
struct Span {
    std::string stage;
    std::uint64_t queued = 0, submitted = 0, started = 0, ended = 0;
    /// What the host spent in the call that put the launch into the queue, ns.
    std::uint64_t host_ns = 0;

    /// Time on the device, ns; 0 where a driver's clock runs backwards.
    std::uint64_t device_ns() const { return ended > started ? ended - started : 0; }
};

struct TimelineState;

/// Records every launch of one device. Nothing blocks.
class Timeline {
  public:
    /// Beyond this many spans that nobody took, the oldest are dropped.
    static constexpr std::size_t kMaxSpans = 65536;

    Timeline();
    ~Timeline();
    Timeline(const Timeline&) = delete;
    Timeline& operator=(const Timeline&) = delete;

    /// Gathers the launches that are complete, without waiting. Throws Error that names the stage
    /// when a launch failed on the device.
    void collect();

    /// Spans of the complete launches that no earlier call returned, in launch order. Does not
    /// wait: after Device::finish() or a blocking map these are all launches before it.
    std::vector<Span> take();

    /// Internal: Kernel::launch() adds to it.
    TimelineState& state() { return *state_; }

  private:
    std::unique_ptr<TimelineState> state_;
};

} // namespace macula::compute
