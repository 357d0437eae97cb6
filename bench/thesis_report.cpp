// What `macula bench thesis` prints for people.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bench/thesis.hpp"

namespace macula::bench {
namespace {

constexpr std::string_view kFoveated = "logpolar", kUpscaled = "logpolar+upscale",
                           kWhole = "logpolar+taa+upscale";
// What the upscaled modes are to reach.
constexpr double kTimeRatio = 0.45, kAddedFlip = 0.02, kFlickerRatio = 0.25, kOverhead = 0.15;

double stage_ms(const ThesisRow& row, ThesisStage stage) {
    return row.stage_ms[static_cast<std::size_t>(stage)];
}

double overhead(const ThesisRow& row) {
    const double rest = stage_ms(row, ThesisStage::remap) + stage_ms(row, ThesisStage::taa) +
                        stage_ms(row, ThesisStage::upscale);
    return row.ms > 0.0 ? rest / row.ms : 0.0;
}

const ThesisRow* row_of(std::span<const ThesisRow> rows, const ThesisRow& view,
                        std::string_view mode) {
    const auto at = std::find_if(rows.begin(), rows.end(), [&](const ThesisRow& row) {
        return row.scene == view.scene && row.view == view.view && row.mode == mode && !row.disk;
    });
    return at == rows.end() ? nullptr : &*at;
}

std::string target(std::string_view what, const ThesisRow& row, double value, double wanted) {
    return fmt::format("  {:<58} {:>8.4f}   at most {:.3f}   {:<7} ({} {})\n", what, value, wanted,
                       value <= wanted ? "met" : "MISSED", row.scene, row.view);
}

// The greatest figure over the views that have one.
class Worst {
  public:
    void add(const ThesisRow& row, double value) {
        if (row_ == nullptr || value > value_) {
            row_ = &row;
            value_ = value;
        }
    }
    std::string line(std::string_view what, double wanted) const {
        return row_ == nullptr ? std::string() : target(what, *row_, value_, wanted);
    }

  private:
    const ThesisRow* row_ = nullptr;
    double value_ = 0.0;
};

double thesis_foveated(const ThesisRow& row) {
    for (const ThesisView& view : thesis_views()) {
        if (view.scene == row.scene && view.view == row.view)
            return thesis_flip(view, kFoveated);
    }
    return 0.0;
}

std::string sweep_summary(std::span<const ThesisRow> rows) {
    std::vector<ThesisRow> sweep;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(sweep),
                 [](const ThesisRow& row) { return row.disk.has_value(); });
    if (sweep.empty())
        return {};
    const auto by_ms = [](const ThesisRow& a, const ThesisRow& b) { return a.ms < b.ms; };
    const auto by_predicted = [](const ThesisRow& a, const ThesisRow& b) {
        return a.predicted < b.predicted;
    };
    const auto [fast, slow] = std::minmax_element(sweep.begin(), sweep.end(), by_ms);
    const auto [few, many] = std::minmax_element(sweep.begin(), sweep.end(), by_predicted);
    std::string text = "\nFigure 5.2: radius of the disk in half diagonals, observed and predicted "
                       "(equation 5.1), each normalised to 0..1\n";
    for (const ThesisRow& row : sweep)
        text += fmt::format(
            "  {:.3f}   {:>8.2f} ms {:.3f}   {:>9.0f} samples, predicted {:>9.0f} {:.3f}\n",
            *row.disk, row.ms, (row.ms - fast->ms) / std::max(slow->ms - fast->ms, 1e-9),
            row.samples, *row.predicted,
            (*row.predicted - *few->predicted) / std::max(*many->predicted - *few->predicted, 1.0));
    return text + fmt::format("  fastest at {:.3f} (thesis: 0.124)\n", *fast->disk);
}

} // namespace

std::string thesis_heading() {
    return fmt::format("{:<16} {:<21} {:>8} {:>8} {:>7} {:>7} {:>7} {:>8} {:>7} {:>7} {:>9} "
                       "{:>9}\n",
                       "view", "mode", "ms", "tracing", "remap", "TAA", "upscale", "samples",
                       "FLIP*", "thesis", "flicker", "at rest");
}

std::string thesis_line(const ThesisRow& row) {
    double thesis = 0.0;
    for (const ThesisView& view : thesis_views()) {
        if (view.scene == row.scene && view.view == row.view && !row.disk)
            thesis = thesis_flip(view, row.mode);
    }
    const std::string mode = row.disk ? fmt::format("{} {:.3f}", row.mode, *row.disk) : row.mode;
    return fmt::format(
        "{:<16} {:<21} {:>8.2f} {:>8.2f} {:>7.2f} {:>7.2f} {:>7.2f} {:>8.0f} {:>7} {:>7} {:>9} "
        "{:>9.2e}\n",
        fmt::format("{} {}", row.scene, row.view), mode, row.ms,
        stage_ms(row, ThesisStage::ray_tracing), stage_ms(row, ThesisStage::remap),
        stage_ms(row, ThesisStage::taa), stage_ms(row, ThesisStage::upscale), row.samples,
        row.disk ? "" : fmt::format("{:.3f}", row.flip_weighted_median),
        thesis > 0.0 ? fmt::format("{:.3f}", thesis) : "",
        row.flicker ? fmt::format("{:.2e}", *row.flicker) : "", row.flicker_still);
}

std::string thesis_summary(std::span<const ThesisRow> rows) {
    if (rows.empty())
        return {};
    const ThesisRow& first = rows.front();
    std::string text = fmt::format(
        "* weighted median of FLIP at 67.02 pixels per degree\n{} x {}, lights {}, {} frames after "
        "{} of warm-up\ndevice {} ({})\n",
        first.width, first.height, frame::name(first.lights), first.frames, first.warm_up,
        first.device, first.driver);
    Worst time, added, foveated, flicker, rest;
    for (const ThesisRow& row : rows) {
        if (row.disk)
            continue;
        const ThesisRow* plain = row_of(rows, row, kFoveated);
        if (row.mode == kFoveated && thesis_foveated(row) > 0.0)
            foveated.add(row, row.flip_weighted_median / thesis_foveated(row));
        if (plain == nullptr || (row.mode != kUpscaled && row.mode != kWhole))
            continue;
        time.add(row, row.ms / plain->ms);
        added.add(row, row.flip_weighted_median - plain->flip_weighted_median);
        rest.add(row, overhead(row));
        if (row.mode == kWhole && row.flicker && plain->flicker && *plain->flicker > 0.0)
            flicker.add(row, *row.flicker / *plain->flicker);
    }
    text += time.line("time, upscaled / not upscaled (thesis: 0.567)", kTimeRatio);
    text += added.line("FLIP added by upscaling (thesis: 0.042)", kAddedFlip);
    text += foveated.line("FLIP of the foveated mode / the thesis's", 1.0);
    text += flicker.line("flicker outside of the disk / that of logpolar", kFlickerRatio);
    text += rest.line("remap, TAA and upscaling / frame (thesis: half)", kOverhead);
    return text + sweep_summary(rows);
}

} // namespace macula::bench
