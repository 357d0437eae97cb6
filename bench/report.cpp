#include "bench/report.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "host/metric/statistics.hpp"

namespace macula::bench {
namespace {

std::string row(const TraversalRecord& r) {
    const char mark = r.chosen ? '*' : ' ';
    if (!r.skipped.empty())
        return fmt::format("  {} {:<26} left out: {}\n", mark, r.variant, r.skipped);
    std::string text = fmt::format(
        "  {} {:<26} {:>8.2f} {:>8.2f}   {:>6.3f} [{:.3f} {:.3f}] {:>7.3f}", mark, r.variant,
        r.mrays_per_s, r.device_mrays_per_s, r.ratio, r.ratio_p10, r.ratio_p90, r.cpu_ratio);
    if (r.mismatches_reference != 0)
        text += fmt::format("  DIFFERS from the reference in {} rays", r.mismatches_reference);
    if (r.mismatches_embree != 0)
        text += fmt::format("  DIFFERS from Embree in {} rays", r.mismatches_embree);
    return text + "\n";
}

// Scenes in the order of the records, each once.
std::vector<std::string> scenes_of(const TraversalReport& report) {
    std::vector<std::string> scenes;
    for (const TraversalRecord& r : report.records) {
        if (std::find(scenes.begin(), scenes.end(), r.scene) == scenes.end())
            scenes.push_back(r.scene);
    }
    return scenes;
}

const TraversalRecord* chosen_record(const TraversalReport& report, const std::string& scene,
                                     kernel::RayClass ray_class) {
    for (const TraversalRecord& r : report.records) {
        if (r.chosen && r.skipped.empty() && r.scene == scene && r.rays == ray_class)
            return &r;
    }
    return nullptr;
}

std::string summary_row(const TraversalReport& report, kernel::RayClass ray_class,
                        std::span<const std::string> scenes) {
    std::string text = fmt::format("  {:<9}", kernel::name(ray_class));
    std::vector<double> ratios;
    for (const std::string& scene : scenes) {
        const TraversalRecord* r = chosen_record(report, scene, ray_class);
        text += r != nullptr ? fmt::format(" {:>20.3f}", r->ratio) : fmt::format(" {:>20}", "-");
        if (r != nullptr)
            ratios.push_back(r->ratio);
    }
    if (ratios.empty())
        return {};
    text += fmt::format("   {:>6.3f} {:>6.3f}", *std::min_element(ratios.begin(), ratios.end()),
                        metric::geometric_mean(ratios));
    if (const std::optional<Target> wanted = target(ray_class))
        text += fmt::format("   ({:.2f} {:.2f})", wanted->every_scene, wanted->geometric_mean);
    return text + "\n";
}

} // namespace

std::optional<Target> target(kernel::RayClass ray_class) {
    switch (ray_class) {
    case kernel::RayClass::primary:
        return Target{1.0, 1.5};
    case kernel::RayClass::shadow:
        return Target{0.9, 1.2};
    case kernel::RayClass::ambient_occlusion:
        return Target{0.85, 1.1};
    case kernel::RayClass::diffuse:
        return Target{1.2, 1.5};
    case kernel::RayClass::sparse:
        return Target{0.8, 1.0};
    case kernel::RayClass::random:
        break;
    }
    return std::nullopt;
}

std::string json_line(const TraversalReport& report, const TraversalRecord& r) {
    nlohmann::ordered_json calls;
    for (std::size_t i = 0; i < kEmbreeCalls.size(); ++i)
        calls[name(kEmbreeCalls[i])] = r.embree_calls[i];
    const nlohmann::ordered_json line{
        {"scene", r.scene},
        {"rays", kernel::name(r.rays)},
        {"variant", r.variant},
        {"chosen", r.chosen},
        {"mrays_per_s", r.mrays_per_s},
        {"device_mrays_per_s", r.device_mrays_per_s},
        {"embree_best", r.embree_best},
        {"embree_mrays_per_s", r.embree_mrays_per_s},
        {"ratio", r.ratio},
        {"ratio_p10", r.ratio_p10},
        {"ratio_p90", r.ratio_p90},
        {"cpu_ratio", r.cpu_ratio},
        {"mismatches", {{"embree", r.mismatches_embree}, {"reference", r.mismatches_reference}}},
        {"explained", {{"ties", r.ties}, {"rounding", r.rounding}}},
        {"ray_count", r.ray_count},
        {"rounds", r.rounds},
        {"embree_calls", calls},
        {"device", report.device},
        {"driver", report.driver},
        {"platform", report.platform},
        {"embree", report.embree},
        {"commit", report.commit}};
    return line.dump();
}

std::string heading(const TraversalReport& report) {
    return fmt::format("device  {}\ndriver  {} ({})\nembree  {}, {} threads\ncommit  {}\n",
                       report.device, report.driver, report.platform, report.embree,
                       report.threads == 0 ? "all" : std::to_string(report.threads), report.commit);
}

std::string table(std::span<const TraversalRecord> records) {
    if (records.empty())
        return {};
    const TraversalRecord& first = records.front();
    std::string text =
        fmt::format("\n{}, {}: {} rays, {} rounds; Embree's best {} {:.2f} Mrays/s (", first.scene,
                    kernel::name(first.rays), first.ray_count, first.rounds, first.embree_best,
                    first.embree_mrays_per_s);
    for (std::size_t i = 0; i < kEmbreeCalls.size(); ++i)
        text += fmt::format("{}{} {:.2f}", i == 0 ? "" : ", ", name(kEmbreeCalls[i]),
                            first.embree_calls[i]);
    text += fmt::format(")\n    {:<26} {:>8} {:>8}   {:>6} [10 %  90 %] by CPU time\n",
                        "variant (* chosen)", "Mrays/s", "device", "ratio");
    for (const TraversalRecord& r : records)
        text += row(r);
    for (const TraversalRecord& r : records) {
        if (!r.skipped.empty() || r.ties + r.rounding == 0)
            continue;
        text +=
            fmt::format("    beside Embree: {} ties, {} differ by rounding\n", r.ties, r.rounding);
        break;
    }
    return text;
}

std::string summary(const TraversalReport& report) {
    const std::vector<std::string> scenes = scenes_of(report);
    std::string text = "\nRatio of the chosen variant to Embree's best\n           ";
    for (const std::string& scene : scenes)
        text += fmt::format("{:>20} ", scene);
    text += "   least   mean   (targets)\n";
    for (const kernel::RayClass ray_class : kernel::kRayClasses)
        text += summary_row(report, ray_class, scenes);
    return text;
}

} // namespace macula::bench
