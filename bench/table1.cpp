#include "bench/table1.hpp"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

namespace macula::bench {
namespace {

// What the rows are to reach.
constexpr double kSpeedupOverPaper = 1.5, kMeanSpeedup = 3.9, kMeanEfficiency = 0.75,
                 kAoEfficiency = 0.9, kPointOverhead = 0.15;

double ms(const FoveationRow& row, StageGroup group) {
    return row.ms[static_cast<std::size_t>(group)];
}

struct Line {
    std::string scene, lights;
    double mrays_full, mrays_ours, reproject, tracing_full, tracing_ours, update, merge, post,
        total_full, total_ours, speedup, efficiency;
};

std::string print(const Line& l) {
    return fmt::format(
        "{:<14} {:<6} {:>6.2f} {:>6.2f} {:>7.2f} {:>8.2f} {:>8.2f} {:>7.2f} {:>7.2f} "
        "{:>7.2f} {:>8.2f} {:>8.2f} {:>7.2f} {:>6.3f}\n",
        l.scene, l.lights, l.mrays_full, l.mrays_ours, l.reproject, l.tracing_full, l.tracing_ours,
        l.update, l.merge, l.post, l.total_full, l.total_ours, l.speedup, l.efficiency);
}

using Figure = std::function<double(const FoveationRow&)>;
using Filter = std::function<bool(const FoveationRow&)>;

bool any(const FoveationRow& /*row*/) {
    return true;
}
bool has_paper(const FoveationRow& row) {
    return paper_row(row.scene, row.lights) != nullptr;
}

std::vector<double> collect(std::span<const FoveationRow> rows, const Filter& filter,
                            const Figure& figure) {
    std::vector<double> values;
    for (const FoveationRow& row : rows) {
        if (filter(row))
            values.push_back(figure(row));
    }
    return values;
}

double mean(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values)
        sum += value;
    return sum / static_cast<double>(values.size());
}

std::string target(const char* what, double value, double wanted, bool at_least) {
    const bool met = at_least ? value >= wanted : value <= wanted;
    return fmt::format("  {:<58} {:>6.3f}   {} {:.3f}   {}\n", what, value,
                       at_least ? "at least" : "at most ", wanted, met ? "met" : "MISSED");
}

} // namespace

std::string table1_heading() {
    return fmt::format("{:<14} {:<6} {:>13} {:>7} {:>17} {:>7} {:>7} {:>7} {:>17} {:>7} {:>6}\n"
                       "{:<14} {:<6} {:>6} {:>6} {:>7} {:>8} {:>8} {:>7} {:>7} {:>7} {:>8} {:>8} "
                       "{:>7} {:>6}\n",
                       "", "", "Mrays", "repro-", "ray tracing, ms", "cache", "merge", "post",
                       "total, ms", "speed-", "effi-", "scene", "lights", "full", "ours", "ject",
                       "full", "ours", "update", "", "", "full", "ours", "up", "ciency");
}

std::string table1_lines(const FoveationRow& row) {
    std::string text =
        print({row.scene, frame::name(row.lights), 1e-6 * row.rays_full, 1e-6 * row.rays_ours,
               ms(row, StageGroup::reproject), row.ms_full, ms(row, StageGroup::ray_tracing),
               ms(row, StageGroup::cache_update), ms(row, StageGroup::merge),
               ms(row, StageGroup::post), row.ms_full, row.ms_ours, row.speedup, row.efficiency});
    if (const PaperRow* p = paper_row(row.scene, row.lights))
        text += print({fmt::format("  {}", p->scene), "paper", p->mrays_full, p->mrays_ours,
                       p->reproject, p->ray_tracing_full, p->ray_tracing_ours, p->cache_update,
                       p->merge, p->post, p->ms_full, p->ms_ours, p->speedup, p->efficiency()});
    text += fmt::format("  {:.1f} % of the pixels; speed-up {:.2f}..{:.2f} (10..90 % of frames), "
                        "{:.2f} by the wall clock ({:.1f} / {:.1f} ms); overhead {:.1f} %\n",
                        100.0 * row.sampled, row.speedup_p10, row.speedup_p90, row.wall_speedup,
                        row.wall_ms_full, row.wall_ms_ours, 100.0 * row.overhead());
    return text;
}

std::string table1_summary(std::span<const FoveationRow> rows) {
    if (rows.empty())
        return {};
    const FoveationRow& first = rows.front();
    std::string text = fmt::format(
        "\n{} rows: {} x {}, {} frames in {} stretches of the path after {} of warm-up, gaze: {}\n"
        "device {} ({})\n",
        rows.size(), first.width, first.height, first.frames, first.segments, first.warm_up,
        first.gaze, first.device, first.driver);
    const auto add = [&](const char* what, double wanted, bool at_least, const Filter& filter,
                         const Figure& figure, const auto& reduce) {
        const std::vector<double> values = collect(rows, filter, figure);
        if (!values.empty())
            text += target(what, reduce(values), wanted, at_least);
    };
    const auto least = [](const std::vector<double>& v) {
        return *std::min_element(v.begin(), v.end());
    };
    const auto most = [](const std::vector<double>& v) {
        return *std::max_element(v.begin(), v.end());
    };
    const Figure speedup = [](const FoveationRow& r) { return r.speedup; };
    const Figure efficiency = [](const FoveationRow& r) { return r.efficiency; };
    const Filter is_ao = [](const FoveationRow& r) {
        return r.lights == frame::LightMode::ambient_occlusion;
    };
    const Filter is_point = [](const FoveationRow& r) {
        return r.lights == frame::LightMode::point;
    };
    add(
        "speed-up by the paper's, least of the rows", kSpeedupOverPaper, true, has_paper,
        [](const FoveationRow& r) { return r.speedup / paper_row(r.scene, r.lights)->speedup; },
        least);
    add("speed-up, mean of the rows (paper: 2.55)", kMeanSpeedup, true, any, speedup, mean);
    add("efficiency, mean of the rows (paper: 0.54)", kMeanEfficiency, true, any, efficiency, mean);
    add("efficiency, least of the ao rows", kAoEfficiency, true, is_ao, efficiency, least);
    add(
        "rays ours / full by the paper's, most of the point rows", 1.0, false,
        [&](const FoveationRow& r) { return is_point(r) && has_paper(r); },
        [](const FoveationRow& r) {
            const PaperRow* p = paper_row(r.scene, r.lights);
            return r.rays_ours / r.rays_full / (p->mrays_ours / p->mrays_full);
        },
        most);
    add(
        "all but ray tracing and shading / full frame, point, most", kPointOverhead, false,
        is_point, [](const FoveationRow& r) { return r.overhead(); }, most);
    return text;
}

} // namespace macula::bench
