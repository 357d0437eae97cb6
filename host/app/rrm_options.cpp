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

} // namespace

void RrmOptions::add_to(CLI::App& command) {
    const auto number = [&](const char* name, auto& value, const char* meaning) {
        command.add_option(name, value, meaning)->capture_default_str()->group("Method rrm");
    };
    number("--rrm-fovea", engine.fovea, "Degrees from the gaze to the foveal rectangle's edges");
    number("--rrm-group", group, "Blocks of a refresh group: WxH, or their number N, 1..132");
    number("--rrm-block", block, "Pixels of a block: 2x2 or 4x1");
    number("--rrm-order", order, "Of a group: horizontal, serpentine, scattered or blue_noise");
    number("--rrm-first-frame", first_frame,
           "Pixels rendered without history: full (all) or turns");
}

stage::RrmOptions engine_options(const RrmOptions& options) {
    stage::RrmOptions engine = options.engine;
    parse_group(options.group, engine);
    engine.order = stage::parse_refresh_order(options.order);
    engine.block_width = is_first("--rrm-block", options.block, "2x2", "4x1") ? 2 : 4;
    engine.first_frame_full = is_first("--rrm-first-frame", options.first_frame, "full", "turns");
    return engine;
}

} // namespace macula::app
