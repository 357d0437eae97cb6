#include "bench/series.hpp"

#include <numeric>

#include "bench/flight.hpp"

namespace macula::bench {

void Series::add(const render::FrameReport& report) {
    const auto groups = sum_by_group(report.stages);
    double sum = 0.0;
    for (std::size_t i = 0; i < kStageGroups; ++i) {
        group_ms[i].push_back(groups[i]);
        sum += groups[i];
    }
    device_ms.push_back(sum);
    wall_ms.push_back(report.wall_ms);
    rays.push_back(static_cast<double>(report.total_rays()));
    camera_rays.push_back(bench::camera_rays(report));
}

double mean(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

} // namespace macula::bench
