// Times of the stages over many frames, by the device's clock.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "host/cl/timeline.hpp"

namespace macula::frame {

struct StageTime {
    std::string stage;
    std::uint32_t launches = 0;
    double device_ms = 0.0; // sum over the launches
    double host_ms = 0.0;   // spent by the host in enqueueing them
};

// One frame's spans, summed by stage, in the order of their first launch.
std::vector<StageTime> sum_by_stage(std::span<const compute::Span> spans);

struct StageStatistics {
    std::string stage;
    std::uint32_t launches = 0; // in the last frame
    double median_ms = 0.0, p95_ms = 0.0, p99_ms = 0.0;
};

class Timings {
  public:
    // Statistics are those of the last frames: memory stays flat however many are rendered.
    static constexpr std::uint32_t kKeptFrames = 4096;

    // `warm_up`: frames at the start that do not count.
    explicit Timings(std::uint32_t warm_up = 1) : warm_up_(warm_up) {}

    // `wall_ms`: of the whole frame, on the host's clock.
    void add(std::span<const StageTime> stages, double wall_ms);
    std::uint32_t frames() const { return static_cast<std::uint32_t>(wall_.size()); }

    // One row a stage, then "all stages" (device), "enqueueing" (host) and "frame" (wall clock).
    std::vector<StageStatistics> statistics() const;

  private:
    struct Row {
        std::uint32_t launches = 0;
        std::vector<double> ms;
    };

    std::uint32_t warm_up_, seen_ = 0;
    std::vector<std::string> order_;
    std::map<std::string, Row> rows_;
    std::vector<double> device_, host_, wall_;
};

// The least value that at least `part` of the values do not exceed; 0 for none.
double percentile(std::vector<double> values, double part);

} // namespace macula::frame
