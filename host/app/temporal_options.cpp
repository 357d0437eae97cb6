#include "host/app/temporal_options.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

namespace macula::app {

void add_temporal_options(CLI::App& command, method::TemporalOptions& options) {
    const auto number = [&](const char* name, float& value, const char* meaning) {
        command.add_option(name, value, meaning)
            ->capture_default_str()
            ->group("Methods ...+taa and ...+upscale");
    };
    number("--ratio", options.ratio, "Pixels of the picture for a rendered one, each way, 1..4");
    number("--frame-rate", options.frame_rate, "Frames a second that smoothing reckons with");
    number("--sharpness", options.sharpness, "Of the enlarged picture, 0..1");
}

} // namespace macula::app
