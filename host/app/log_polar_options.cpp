#include "host/app/log_polar_options.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

namespace macula::app {

void add_log_polar_options(CLI::App& command, stage::LogPolarOptions& options) {
    const auto number = [&](const char* name, float& value, const char* meaning) {
        command.add_option(name, value, meaning)
            ->capture_default_str()
            ->group("Methods logpolar and logrect");
    };
    number("--alpha", options.alpha, "Of the kernel function K(x) = x^alpha, 1..16");
    number("--rect-alpha", options.rect_alpha, "The same of method logrect, 1..16");
    number("--sigma", options.sigma, "Pixels for a texel of the buffer along each axis, 1..16");
    number("--disk", options.disk, "Radius of the foveal disk in half diagonals of the image");
    number("--disk-degrees", options.disk_degrees, "The same in degrees; 0: --disk counts");
    command
        .add_option_function<std::string>(
            "--lod",
            [&options](const std::string& text) { options.lod = stage::parse_lod_rule(text); },
            "How textures are filtered: footprint (of a sample's texel) or thesis (a bias)")
        ->default_str(stage::name(options.lod))
        ->group("Methods logpolar and logrect");
    number("--disk-fade", options.fade, "Part of the radius in which the disk fades out, 0..1");
}

} // namespace macula::app
