// What `macula bench rrm` prints for people.
#include <algorithm>

#include <fmt/format.h>

#include "bench/rrm.hpp"

namespace macula::bench {
namespace {

constexpr double kEfficiency = 0.85, kPhysicsSpeedup = 2.5, kPaperPhysicsSpeedup = 1.8;

std::string method_of(const RrmRow& row) {
    return row.method == "rrm" ? fmt::format("rrm {}", row.n) : row.method;
}

std::string speed_line(const RrmRow& row, const RrmSpeed& s) {
    double rest = 0.0;
    for (std::size_t i = 0; i < kStageGroups; ++i) {
        if (i != static_cast<std::size_t>(StageGroup::ray_tracing))
            rest += s.ms[i];
    }
    return fmt::format("{:<18} {:<14} {:>9.2f} {:>9.2f} {:>8.2f} {:>10.3f} {:>9.2f} {:>8.2f} "
                       "{:>10.0f} {:>10.0f}\n",
                       row.name, method_of(row), s.fps_full(), s.fps_ours(), s.speedup(),
                       s.efficiency(), s.ms_ours, rest, s.samples_full, s.samples_ours);
}

std::string quality_line(const RrmRow& row, const RrmQuality& q) {
    return fmt::format("quality, {:<16} {:<14} FLIP {:.4f}, foveated {:.4f}, flicker {:.2e}, "
                       "instability {:.2e}, {:.0f} samples\n",
                       row.scene, method_of(row), q.flip, q.foveated_flip, q.flicker, q.instability,
                       q.samples);
}

std::string physics_line(const RrmRow& row, const PhysicsResult& p) {
    return fmt::format("physics of {}, {} frames, {} gazes: {:.3f} ms exact, {:.3f} ms perceptual, "
                       "speed-up {:.2f}; coarse everywhere {:.3f} ms, {:.2f}; penetration {:.3f} "
                       "and {:.3f} radii, bound {:.3f}\n",
                       row.scene, p.frames, p.gazes, p.ms_exact, p.ms_perceptual, p.speedup,
                       p.ms_coarse, p.speedup_coarse, p.penetration_exact, p.penetration_perceptual,
                       p.bound);
}

std::string target(const std::string& what, double value, double wanted, bool met) {
    return fmt::format("  {:<44} {:>7.2f}   wanted {:.2f}   {}\n", what, value, wanted,
                       met ? "met" : "MISSED");
}

// What is said of a case's speed: the second one is to be above the paper's.
std::string targets(const RrmRow& row, const RrmCase& one) {
    const double speedup = row.speed->speedup();
    const bool met = one.secondary ? speedup > one.target_speedup : speedup >= one.target_speedup;
    return target(fmt::format("{}: speed-up (paper: {})", one.name, one.paper_speedup), speedup,
                  one.target_speedup, met) +
           fmt::format("  {:<44} {:>7.2f}\n",
                       fmt::format("{}: the same by the mean of frame rates", one.name),
                       row.speed->mean_rate / row.speed->fps_full()) +
           target(fmt::format("{}: efficiency", one.name), row.speed->efficiency(), kEfficiency,
                  row.speed->efficiency() >= kEfficiency);
}

std::string physics_targets(const RrmRow& row, const PhysicsResult& p) {
    return target(fmt::format("{}: speed-up (paper: {})", row.scene, kPaperPhysicsSpeedup),
                  p.speedup, kPhysicsSpeedup, p.speedup >= kPhysicsSpeedup) +
           target(fmt::format("{}: penetration, radii", row.scene), p.penetration_perceptual,
                  p.bound, p.penetration_perceptual <= p.bound);
}

const RrmRow* quality_of(std::span<const RrmRow> rows, const RrmRow& like, std::uint32_t n) {
    const auto at = std::find_if(rows.begin(), rows.end(), [&](const RrmRow& row) {
        return row.quality && row.scene == like.scene && row.method == "rrm" && row.n == n;
    });
    return at == rows.end() ? nullptr : &*at;
}

// Figure 10: a longer cycle is more noticeable.
std::string order(std::span<const RrmRow> rows) {
    std::string text;
    for (const RrmRow& row : rows) {
        if (!row.quality || row.method != "rrm" || row.n != 132)
            continue;
        const RrmRow* fewer = quality_of(rows, row, 12);
        if (fewer == nullptr)
            continue;
        const RrmQuality &a = *fewer->quality, &b = *row.quality;
        const bool ordered = a.foveated_flip < b.foveated_flip && a.flicker < b.flicker;
        text += fmt::format("  {}: foveated FLIP and flicker of N = 12 {} those of N = 132\n",
                            row.scene, ordered ? "below" : "NOT BELOW");
    }
    return text;
}

} // namespace

std::string rrm_heading() {
    return fmt::format("{:<18} {:<14} {:>9} {:>9} {:>8} {:>10} {:>9} {:>8} {:>10} {:>10}\n", "case",
                       "method", "full, fps", "ours, fps", "speed-up", "efficiency", "ours, ms",
                       "not rays", "samples", "ours");
}

std::string rrm_line(const RrmRow& row) {
    if (row.speed)
        return speed_line(row, *row.speed);
    if (row.quality)
        return quality_line(row, *row.quality);
    return row.physics ? physics_line(row, *row.physics) : std::string();
}

std::string rrm_summary(std::span<const RrmRow> rows) {
    if (rows.empty())
        return {};
    std::string text;
    for (const RrmRow& row : rows) {
        if (row.physics)
            text += physics_targets(row, *row.physics);
        for (const RrmCase& one : rrm_cases()) {
            if (row.speed && row.name == one.name && row.method == "rrm")
                text += targets(row, one);
        }
    }
    const RrmRow& first = rows.front();
    if (first.speed)
        text =
            fmt::format("{} x {}, {}, {} x {} foveal positions, {} frames at each\n", first.width,
                        first.height, first.display, first.columns, first.rows, first.frames) +
            text;
    return fmt::format("device {} ({})\n", first.device, first.driver) + text + order(rows);
}

} // namespace macula::bench
