// What methods share that gather samples over frames: the size that they render, the jitter of
// their samples, and the stages that follow those of the method itself.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "host/method/method.hpp"
#include "host/stage/temporal.hpp"

namespace macula::method {
namespace {

constexpr std::uint32_t kPhases = 16; // of the jitter for a pixel that is rendered (4.3.2)

void require(const char* option, float value, float least, float most) {
    if (!(value >= least && value <= most))
        throw std::invalid_argument(
            fmt::format("{} must be {} to {}, not {}", option, least, most, value));
}

std::uint32_t shrunk(std::uint32_t pixels, float ratio) {
    return std::max(static_cast<std::uint32_t>(std::lround(static_cast<float>(pixels) / ratio)),
                    1u);
}

} // namespace

void check(const TemporalOptions& o) {
    require("the ratio of the picture to what is rendered", o.ratio, 1.0f, 4.0f);
    require("the frame rate", o.frame_rate, 1.0f, 1000.0f);
    require("the sharpness", o.sharpness, 0.0f, 1.0f);
}

Size Method::render_size(std::uint32_t width, std::uint32_t height,
                         const TemporalOptions& t) const {
    check(t);
    if (!upscaled)
        return {width, height};
    return {shrunk(width, t.ratio), shrunk(height, t.ratio)};
}

std::uint32_t Method::jitter_phases(std::uint32_t width, const TemporalOptions& t) const {
    if (!antialiased && !upscaled)
        return 0;
    const double ratio = static_cast<double>(width) / render_size(width, 1, t).width;
    return kPhases * static_cast<std::uint32_t>(std::ceil(ratio * ratio));
}

const char* Method::picture() const {
    return upscaled ? "upscaled colour" : antialiased ? "stable colour" : "colour";
}

frame::Graph Method::make(const stage::Kit& kit, const Options& options) const {
    Options own = options;
    own.smoothed = antialiased || upscaled;
    frame::Graph graph = base(kit, own);
    graph.rename(name, purpose);
    if (!antialiased && !upscaled)
        return graph;
    const std::vector<std::string> made = graph.resources();
    const auto makes = [&](const char* what) {
        return std::find(made.begin(), made.end(), what) != made.end();
    };
    const bool foveated = makes("fovea");
    const TemporalOptions& t = options.temporal;
    const stage::TemporalKit temporal{kit,          foveated,    antialiased,          upscaled,
                                      t.frame_rate, t.sharpness, makes("fresh pixels")};
    if (!foveated)
        graph.add(stage::follow_surfaces(temporal));
    if (antialiased)
        graph.add(stage::antialias(temporal));
    else
        graph.add(stage::split_colour(temporal));
    if (upscaled)
        graph.add(stage::upscale(temporal));
    return graph;
}

} // namespace macula::method
