#include "host/app/compare_options.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "scenes/gaze/spec.hpp"

namespace macula::app {
namespace {

using scene::Eye;

[[noreturn]] void refuse(const char* option, const std::string& value, const char* expected) {
    throw std::invalid_argument(fmt::format("{} \"{}\": {}", option, value, expected));
}

Eye parse_eye(const std::string& text) {
    for (const Eye eye : {Eye::mono, Eye::left, Eye::right}) {
        if (text == scene::name(eye))
            return eye;
    }
    refuse("--eye", text, "mono, left or right was expected");
}

double density_on_axis(const scene::Display& display, Eye eye) {
    double x = 0.0, y = 0.0;
    scene::project(display, eye, -display.eye(eye).head_from_eye[2], x, y);
    return scene::pixels_per_degree(display, eye, x, y);
}

metric::Exposures parse_exposures(const std::string& text) {
    metric::Exposures e;
    int end = 0;
    const char* at = text.c_str();
    if (std::sscanf(at, "%lf:%lf%n", &e.start, &e.stop, &end) == 2 && std::isfinite(e.start) &&
        std::isfinite(e.stop) && e.start <= e.stop && e.stop - e.start <= 500.0) {
        e.count = static_cast<unsigned>(std::max(2.0, std::ceil(e.stop - e.start)));
        at += end;
        if (*at == '\0' || (std::sscanf(at, ":%u%n", &e.count, &end) == 1 && at[end] == '\0'))
            return e;
    }
    refuse("--exposures", text, "START:STOP[:COUNT] in stops was expected, START <= STOP");
}

metric::ToneMapper parse_tone_mapper(const std::string& text) {
    if (text == "aces")
        return metric::ToneMapper::aces;
    if (text == "hable")
        return metric::ToneMapper::hable;
    if (text == "reinhard")
        return metric::ToneMapper::reinhard;
    refuse("--tone-mapper", text, "aces, hable or reinhard was expected");
}

} // namespace

void CompareOptions::add_to(CLI::App& command) {
    command
        .add_option("pictures", pictures,
                    "The reference, then one or more tests: PNG or EXR files, folders of frames, "
                    "or patterns as frame_%04d.exr")
        ->required()
        ->expected(2, 1000);
    command.add_option("--ppd", pixels_per_degree,
                       "Pixels per degree (default: the display's, else 67.02)");
    command.add_option("--display", display,
                       "A name of `macula displays` or a file .toml or .json");
    command.add_option("--eye", eye, "Of the display: mono, left or right")->capture_default_str();
    command.add_option("--gaze", gaze,
                       "Where the eye looks, as render takes it: scores around the gaze");
    command.add_option("--tracker", tracker, "What an eye tracker makes of it, as render takes it");
    command.add_flag("--hdr", hdr, "HDR-FLIP: linear light seen at many exposures (EXR only)");
    command.add_option("--exposures", exposures, "START:STOP[:COUNT] in stops (default: found)");
    command.add_option("--tone-mapper", tone_mapper, "Of HDR-FLIP: aces, hable or reinhard")
        ->capture_default_str();
    command.add_option("--frames", frames, "A:B, frames A to B - 1 of sequences (default: all)");
    command.add_option("--motion", motion,
                       "Sequence of EXR files with Motion.X and Motion.Y (default: the "
                       "reference's, where it has them)");
    command.add_flag("--still", still, "The camera does not move: no motion is compensated");
    command.add_option("--heatmap", heat_map,
                       "File of the FLIP errors: .png (magma) or .exr (numbers)");
    command.add_option("--foveated-heatmap", foveated_heat_map,
                       "The same of the foveated FLIP errors (needs --gaze)");
    command.add_flag("--json", json, "One JSON document a line for each test");
}

CompareView::CompareView(const CompareOptions& options, std::uint32_t width, std::uint32_t height)
    : eye_(parse_eye(options.eye)) {
    pixels_per_degree_ = options.pixels_per_degree.value_or(metric::kDefaultPixelsPerDegree);
    source_ = options.pixels_per_degree ? "--ppd" : "default";
    if (!(pixels_per_degree_ >= metric::kMinPixelsPerDegree &&
          pixels_per_degree_ <= metric::kMaxPixelsPerDegree))
        refuse("--ppd", fmt::format("{}", pixels_per_degree_), "0.1 to 2000 were expected");
    if (options.display.empty()) {
        display_ = metric::flat_display(width, height, pixels_per_degree_);
    } else {
        display_ = scene::find_display(options.display);
        display_.width = width;
        display_.height = height;
        if (!options.pixels_per_degree) {
            pixels_per_degree_ = density_on_axis(display_, eye_);
            source_ = "display";
        }
    }
    const bool has_gaze = !options.gaze.empty() && options.gaze != "none";
    if (!has_gaze && !options.tracker.empty())
        refuse("--tracker", options.tracker, "it needs --gaze");
    if (has_gaze)
        gaze_ = scene::tracked(scene::parse_gaze(options.gaze, {display_, eye_, {}}),
                               scene::parse_tracker(options.tracker));
    if (gaze_ && gaze_->live())
        refuse("--gaze", options.gaze, "a live source is no record of what was looked at");
    if (!gaze_ && !options.foveated_heat_map.empty())
        refuse("--foveated-heatmap", options.foveated_heat_map, "it needs --gaze");
}

metric::View CompareView::at(std::uint32_t frame) {
    const scene::GazeSample sample = gaze_->at(std::llround(frame * (1e9 / display_.refresh_hz)));
    return {metric::eccentricity_map(display_, eye_, sample.of(eye_)),
            metric::density_map(display_, eye_)};
}

metric::ScoreOptions score_options(const CompareOptions& options, double pixels_per_degree) {
    metric::ScoreOptions score;
    score.pixels_per_degree = pixels_per_degree;
    score.hdr = options.hdr;
    score.tone_mapper = parse_tone_mapper(options.tone_mapper);
    if (!options.exposures.empty()) {
        if (!options.hdr)
            refuse("--exposures", options.exposures, "it needs --hdr");
        score.exposures = parse_exposures(options.exposures);
    }
    return score;
}

} // namespace macula::app
