#include "host/app/compare_report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace macula::app {
namespace {

using nlohmann::ordered_json;

/// JSON knows no infinity: null.
ordered_json number(double value) {
    return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

void add_pooled(ordered_json& json, const char* prefix, const metric::Pooled& p) {
    const std::string name = prefix;
    json[name + "_mean"] = p.mean;
    json[name + "_weighted_median"] = p.weighted_median;
    json[name + "_q1"] = p.weighted_q1;
    json[name + "_q3"] = p.weighted_q3;
    json[name + "_min"] = p.min;
    json[name + "_max"] = p.max;
}

void add_temporal(ordered_json& json, const metric::TemporalScore& score) {
    json["temporal_pixels"] = score.pixels;
    json["instability"] = score.instability;
    json["flicker_energy"] = score.flicker_energy;
}

ordered_json bands_json(const metric::FrameScores& scores,
                        const std::vector<metric::TemporalScore>& temporal) {
    ordered_json bands = ordered_json::array();
    for (std::size_t b = 0; b < scores.bands.size(); ++b) {
        const metric::BandScore& score = scores.bands[b];
        ordered_json band{{"name", score.band.name},
                          {"from_degrees", score.band.from},
                          {"to_degrees", std::min(score.band.to, 180.0)},
                          {"pixels", score.pixels}};
        if (score.pixels > 0) {
            add_pooled(band, "flip", score.errors);
            add_pooled(band, "foveated_flip", scores.foveated_bands[b].errors);
        }
        if (!temporal.empty())
            add_temporal(band, temporal[b]);
        bands.push_back(band);
    }
    return bands;
}

void add_scores(ordered_json& json, const metric::FrameScores& scores,
                const std::vector<metric::TemporalScore>& temporal) {
    add_pooled(json, "flip", scores.flip);
    json["mse"] = scores.mse;
    json["psnr"] = number(scores.psnr);
    json["ssim"] = scores.ssim;
    if (scores.exposures)
        json["exposures"] = {{"start", scores.exposures->start},
                             {"stop", scores.exposures->stop},
                             {"count", scores.exposures->count}};
    if (!scores.bands.empty())
        add_pooled(json, "foveated_flip", scores.foveated);
    if (!temporal.empty())
        add_temporal(json, temporal.back());
    json["bands"] = bands_json(scores, temporal);
}

std::string line(const std::string& name, const metric::Pooled& p) {
    return fmt::format("  {:<28} {:8.6f} {:8.6f} {:8.6f} {:8.6f} {:8.6f} {:8.6f}\n", name, p.mean,
                       p.weighted_median, p.weighted_q1, p.weighted_q3, p.min, p.max);
}

std::string degrees(const metric::Band& band) {
    return fmt::format("{} {:g}-{:g} deg", band.name, band.from, std::min(band.to, 180.0));
}

} // namespace

std::string compare_json(const Compared& result, const CompareOptions& options) {
    ordered_json json{{"reference", result.reference},
                      {"test", result.test},
                      {"width", result.width},
                      {"height", result.height},
                      {"frames", result.frames.size()},
                      {"metric", options.hdr ? "HDR-FLIP" : "LDR-FLIP"},
                      {"ppd", result.pixels_per_degree},
                      {"ppd_source", result.pixels_per_degree_source},
                      {"display", nullptr},
                      {"gaze", nullptr}};
    if (!result.display.empty())
        json["display"] = result.display;
    if (!result.mean.bands.empty())
        json["gaze"] = options.gaze;
    const bool single = result.frames.size() == 1;
    metric::FrameScores mean = result.mean;
    if (single)
        mean.exposures = result.frames.front().scores.exposures;
    add_scores(json, mean, result.temporal);
    if (!result.no_temporal.empty() && !single)
        json["no_temporal_scores"] = result.no_temporal;
    if (!single) {
        json["per_frame"] = ordered_json::array();
        for (const ComparedFrame& frame : result.frames) {
            ordered_json entry{{"frame", frame.frame}};
            add_scores(entry, frame.scores, frame.temporal);
            json["per_frame"].push_back(entry);
        }
    }
    if (!result.heat_maps.empty())
        json["heat_maps"] = result.heat_maps;
    return json.dump() + "\n";
}

std::string compare_text(const Compared& result, const CompareOptions& options) {
    std::string text = fmt::format(
        "{} against {}: {} frame{} of {} x {} pixels, {:.2f} pixels per degree ({})\n", result.test,
        result.reference, result.frames.size(), result.frames.size() == 1 ? "" : "s", result.width,
        result.height, result.pixels_per_degree, result.pixels_per_degree_source);
    text += fmt::format("  {:<28} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8}\n", "", "mean", "w.median",
                        "w.q1", "w.q3", "min", "max");
    text += line(options.hdr ? "HDR-FLIP" : "FLIP", result.mean.flip);
    for (const metric::BandScore& score : result.mean.bands) {
        if (score.pixels > 0)
            text += line("  " + degrees(score.band), score.errors);
    }
    if (!result.mean.bands.empty())
        text += line("foveated FLIP", result.mean.foveated);
    for (const metric::BandScore& score : result.mean.foveated_bands) {
        if (score.pixels > 0)
            text += line("  " + degrees(score.band), score.errors);
    }
    text += fmt::format("  PSNR {:.3f} dB, SSIM {:.6f}, MSE {:.6g}\n", result.mean.psnr,
                        result.mean.ssim, result.mean.mse);
    for (const metric::TemporalScore& score : result.temporal) {
        if (score.pixels > 0)
            text += fmt::format("  {:<28} instability {:+.6f}, flicker energy {:.3e}\n",
                                degrees(score.band), score.instability, score.flicker_energy);
    }
    if (!result.no_temporal.empty() && result.frames.size() > 1)
        text += fmt::format("  no temporal scores: {}\n", result.no_temporal);
    for (const std::string& file : result.heat_maps)
        text += fmt::format("  wrote {}\n", file);
    return text;
}

} // namespace macula::app
