#include "host/cl/timeline.hpp"

#include "host/cl/state.hpp"

#include <utility>

namespace macula::compute {
namespace {

/// Gather what is complete now and then, so that a caller who never asks holds no events forever.
constexpr std::size_t kCollectEvery = 1024;

cl_ulong profiling_value(const cl::Event& event, cl_profiling_info name) {
    cl_ulong value = 0;
    const cl_int status = clGetEventProfilingInfo(event(), name, sizeof value, &value, nullptr);
    return status == CL_SUCCESS ? value : 0;
}

Span span_of(TimelineState::Launch launch) {
    Span span;
    span.queued = profiling_value(launch.event, CL_PROFILING_COMMAND_QUEUED);
    span.submitted = profiling_value(launch.event, CL_PROFILING_COMMAND_SUBMIT);
    span.started = profiling_value(launch.event, CL_PROFILING_COMMAND_START);
    span.ended = profiling_value(launch.event, CL_PROFILING_COMMAND_END);
    span.host_ns = launch.host_ns;
    span.stage = std::move(launch.stage);
    return span;
}

cl_int status_of(const TimelineState::Launch& launch) {
    cl_int result = CL_QUEUED;
    const cl_int status = clGetEventInfo(launch.event(), CL_EVENT_COMMAND_EXECUTION_STATUS,
                                         sizeof result, &result, nullptr);
    return status == CL_SUCCESS ? result : status;
}

} // namespace

void TimelineState::add(Launch launch) {
    pending.push_back(std::move(launch));
    if (pending.size() % kCollectEvery == 0)
        collect();
}

void TimelineState::collect() {
    while (!pending.empty()) {
        const cl_int status = status_of(pending.front());
        if (status > CL_COMPLETE)
            return;
        Launch launch = std::move(pending.front());
        pending.pop_front();
        if (status < 0)
            throw Error("stage \"" + launch.stage + "\" failed on the device", status);
        done.push_back(span_of(std::move(launch)));
        if (done.size() > Timeline::kMaxSpans)
            done.pop_front();
    }
}

Timeline::Timeline() : state_(std::make_unique<TimelineState>()) {}

Timeline::~Timeline() = default;

void Timeline::collect() {
    state_->collect();
}

std::vector<Span> Timeline::take() {
    collect();
    std::vector<Span> spans(std::make_move_iterator(state_->done.begin()),
                            std::make_move_iterator(state_->done.end()));
    state_->done.clear();
    return spans;
}

} // namespace macula::compute
