#include "host/frame/timings.hpp"

#include <algorithm>
#include <cmath>

namespace macula::frame {
namespace {

StageStatistics summary(const std::string& stage, std::uint32_t launches,
                        const std::vector<double>& ms) {
    return {stage, launches, percentile(ms, 0.5), percentile(ms, 0.95), percentile(ms, 0.99)};
}

// The value of frame number `frame` takes the place of the one kKeptFrames before.
void keep(std::vector<double>& values, std::uint32_t frame, double value) {
    const std::size_t place = frame % Timings::kKeptFrames;
    if (place < values.size())
        values[place] = value;
    else
        values.push_back(value);
}

} // namespace

std::vector<StageTime> sum_by_stage(std::span<const compute::Span> spans) {
    std::vector<StageTime> stages;
    for (const compute::Span& span : spans) {
        auto found = std::find_if(stages.begin(), stages.end(),
                                  [&](const StageTime& s) { return s.stage == span.stage; });
        if (found == stages.end())
            found = stages.insert(stages.end(), {span.stage, 0, 0.0, 0.0});
        ++found->launches;
        found->device_ms += static_cast<double>(span.device_ns()) * 1e-6;
        found->host_ms += static_cast<double>(span.host_ns) * 1e-6;
    }
    return stages;
}

void Timings::add(std::span<const StageTime> stages, double wall_ms) {
    if (seen_++ < warm_up_)
        return;
    const std::uint32_t frame = seen_ - warm_up_ - 1;
    double device = 0.0, host = 0.0;
    for (const StageTime& stage : stages) {
        if (!rows_.contains(stage.stage))
            order_.push_back(stage.stage);
        Row& row = rows_[stage.stage];
        row.launches = stage.launches;
        keep(row.ms, frame, stage.device_ms);
        device += stage.device_ms;
        host += stage.host_ms;
    }
    keep(device_, frame, device);
    keep(host_, frame, host);
    keep(wall_, frame, wall_ms);
}

std::vector<StageStatistics> Timings::statistics() const {
    std::vector<StageStatistics> result;
    std::uint32_t launches = 0;
    for (const std::string& stage : order_) {
        const Row& row = rows_.at(stage);
        result.push_back(summary(stage, row.launches, row.ms));
        launches += row.launches;
    }
    result.push_back(summary("all stages", launches, device_));
    result.push_back(summary("enqueueing", launches, host_));
    result.push_back(summary("frame", launches, wall_));
    return result;
}

double percentile(std::vector<double> values, double part) {
    if (values.empty())
        return 0.0;
    std::sort(values.begin(), values.end());
    const double rank = std::ceil(part * static_cast<double>(values.size())) - 1.0;
    const double last = static_cast<double>(values.size() - 1);
    return values[static_cast<std::size_t>(std::clamp(rank, 0.0, last))];
}

} // namespace macula::frame
