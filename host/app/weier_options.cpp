#include "host/app/weier_options.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <limits>
#include <stdexcept>

namespace macula::app {
namespace {

struct NamedRegion {
    const char* name;
    float r0, r1, p_min;
};

constexpr float kAll = std::numeric_limits<float>::infinity();
constexpr std::array kRegions = {
    NamedRegion{"small", 5.0f, 10.0f, 0.01f},
    NamedRegion{"medium", 10.0f, 20.0f, 0.05f},
    NamedRegion{"large", 15.0f, 30.0f, 0.1f},
    NamedRegion{"full", kAll, kAll, 1.0f},
};

// Which of an option's two words it is.
bool is_first(const char* option, const std::string& value, const char* first, const char* second) {
    if (value != first && value != second)
        throw std::invalid_argument(
            fmt::format("{} \"{}\": {} or {} was expected", option, value, first, second));
    return value == first;
}

} // namespace

void parse_frc(const std::string& text, stage::WeierOptions& options) {
    for (const NamedRegion& region : kRegions) {
        if (text == region.name) {
            options.r0 = region.r0;
            options.r1 = region.r1;
            options.p_min = region.p_min;
            return;
        }
    }
    int end = 0;
    if (std::sscanf(text.c_str(), "%f,%f,%f%n", &options.r0, &options.r1, &options.p_min, &end) !=
            3 ||
        text[static_cast<std::size_t>(end)] != '\0')
        throw std::invalid_argument(fmt::format(
            "--frc \"{}\": small, medium, large, full or R0,R1,PMIN was expected", text));
}

void WeierOptions::add_to(CLI::App& command) {
    const auto number = [&](const char* name, auto& value, const char* meaning) {
        command.add_option(name, value, meaning)->capture_default_str()->group("Method weier");
    };
    number("--frc", frc, "Foveal region: small, medium, large, full or R0,R1,PMIN in degrees");
    command
        .add_option("--support", support, "WxH samples of the support image (a cell: 4.6 pixels)")
        ->group("Method weier");
    number("--first-frame", first_frame, "Pixels sampled without history: full (all) or sparse");
    number("--new-parts", new_parts, "What enters the view: sample all of it, or fill it");
    number("--eps-depth", engine.depth_threshold, "Resample beyond this part of the depth");
    number("--eps-lum", engine.luminance_threshold, "Resample beyond this luminance, 0..1");
    number("--eps-edge", engine.edge_threshold, "Resample surfaces below this cosine");
    number("--eps-stretch", engine.stretch_threshold, "Resample where pixels grow beyond this");
    number("--eps-merge", engine.merge_threshold, "Keep the cache up to this part of the depth");
    number("--k-min", engine.k_min, "Least weight of a sample after one frame");
    number("--k-max", engine.k_max, "Least weight after t-max frames");
    number("--t-max", engine.t_max, "Frames");
    number("--resampled-worth", engine.resampled_worth,
           "Of a history read between its texels, 0..1; 1: as if it were not blurred");
    number("--footprint-samples", engine.filter_samples, "Of a reprojected footprint, 0..64");
    number("--post-window", engine.filter_window, "Pixels that the post-processor looks around");
    number("--post-tries", engine.filter_tries, "Pixels that it tries");
    command.add_option("--lowres-scale", lowres_scale, "Part of the pixels along each axis, 0..1")
        ->capture_default_str()
        ->group("Method lowres");
    command.add_flag("--no-post", no_post, "No post-processor for area lights and ao")
        ->group("Method weier");
    command.add_flag("--no-catch-up", no_catch_up, "The history keeps highlights as it saw them")
        ->group("Method weier");
    command.add_flag("--jitter", engine.jitter, "Rays through a random point of the pixel")
        ->group("Method weier");
    command.add_flag("--overlay", engine.overlay, "Draw foveal circles and sampled pixels")
        ->group("Method weier");
}

stage::WeierOptions engine_options(const WeierOptions& options) {
    stage::WeierOptions engine = options.engine;
    parse_frc(options.frc, engine);
    engine.post = !options.no_post;
    engine.catch_up = !options.no_catch_up;
    engine.first_frame_full = is_first("--first-frame", options.first_frame, "full", "sparse");
    engine.resample_new = is_first("--new-parts", options.new_parts, "sample", "fill");
    if (!options.support.empty()) {
        int end = 0;
        if (std::sscanf(options.support.c_str(), "%ux%u%n", &engine.support_width,
                        &engine.support_height, &end) != 2 ||
            options.support[static_cast<std::size_t>(end)] != '\0' || engine.support_width < 2 ||
            engine.support_height < 2)
            throw std::invalid_argument(
                fmt::format("--support \"{}\": WxH of at least 2x2 was expected", options.support));
    }
    return engine;
}

} // namespace macula::app
