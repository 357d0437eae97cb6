#include "host/app/rrm_options.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <cstdio>
#include <stdexcept>

namespace macula::app {
namespace {

// Which of an option's two words it is.
bool is_first(const char* option, const std::string& value, const char* first, const char* second) {
    if (value != first && value != second)
        throw std::invalid_argument(
            fmt::format("{} \"{}\": {} or {} was expected", option, value, first, second));
    return value == first;
}

void parse_group(const std::string& text, stage::RrmOptions& engine) {
    unsigned width = 0, height = 0;
    int used = 0;
    if (std::sscanf(text.c_str(), "%ux%u%n", &width, &height, &used) == 2 &&
        text[static_cast<std::size_t>(used)] == '\0') {
        engine.group_width = width;
        engine.group_height = height;
        return;
    }
    if (std::sscanf(text.c_str(), "%u%n", &width, &used) == 1 &&
        text[static_cast<std::size_t>(used)] == '\0') {
        stage::set_group(engine, width);
        return;
    }
    throw std::invalid_argument(
        fmt::format("--rrm-group \"{}\": WxH blocks or their number was expected", text));
}

stage::RefreshRing parse_ring(const std::string& text) {
    stage::RefreshRing ring{};
    int used = 0;
    if (std::sscanf(text.c_str(), "%f:%u%n", &ring.degrees, &ring.period, &used) != 2 ||
        text[static_cast<std::size_t>(used)] != '\0')
        throw std::invalid_argument(
            fmt::format("--rrm-rings \"{}\": DEGREES:FRAMES was expected", text));
    return ring;
}

} // namespace

void RrmOptions::add_to(CLI::App& command) {
    const auto number = [&](const char* name, auto& value, const char* meaning) {
        command.add_option(name, value, meaning)->capture_default_str()->group("Method rrm");
    };
    number("--rrm-fovea", engine.fovea, "Degrees from the gaze to the foveal rectangle's edges");
    number("--rrm-shape", shape, "Of the fovea: rectangle, or the disk inside of it");
    number("--rrm-foveal-spp", engine.foveal_samples, "Samples of a foveal pixel, if more");
    command.add_option("--rrm-rings", rings, "DEGREES:FRAMES,...: refreshed so often up to there")
        ->delimiter(',')
        ->group("Method rrm");
    number("--rrm-busy-change", engine.busy.change,
           "Refresh more where a colour changes by so much, 0..1; 0: nowhere");
    number("--rrm-busy-motion", engine.busy.motion,
           "Refresh more where pixels move by so many a frame; 0: nowhere");
    number("--rrm-busy-times", engine.busy.times, "So many times as often");
    number("--rrm-busy-frames", engine.busy.frames, "For so many frames");
    number("--rrm-busy-budget", engine.busy.budget, "With at most that part of the pixels a frame");
    number("--rrm-group", group, "Blocks of a refresh group: WxH, or their number N, 1..132");
    number("--rrm-block", block, "Pixels of a block: 2x2 or 4x1");
    number("--rrm-groups", groups, "interlaced by four, their due blocks touch, or apart");
    number("--rrm-order", order, "Of a group: horizontal, serpentine, scattered or blue_noise");
    number("--rrm-cut", cut, "What a turn by half of the view renders: full or stale (the turns)");
    number("--rrm-first-frame", first_frame,
           "Pixels rendered without history: full (all) or turns");
}

stage::RrmOptions engine_options(const RrmOptions& options) {
    stage::RrmOptions engine = options.engine;
    parse_group(options.group, engine);
    engine.order = stage::parse_refresh_order(options.order);
    engine.block_width = is_first("--rrm-block", options.block, "2x2", "4x1") ? 2 : 4;
    engine.interlaced = is_first("--rrm-groups", options.groups, "interlaced", "apart");
    engine.first_frame_full = is_first("--rrm-first-frame", options.first_frame, "full", "turns");
    engine.cut_full = is_first("--rrm-cut", options.cut, "full", "stale");
    engine.disk = !is_first("--rrm-shape", options.shape, "rectangle", "disk");
    for (const std::string& ring : options.rings)
        engine.rings.push_back(parse_ring(ring));
    return engine;
}

} // namespace macula::app
