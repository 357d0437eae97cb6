// The methods by name: ways to make a frame. A method is one file that lists its stages, and one
// line in registry.cpp.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "host/frame/graph.hpp"
#include "host/frame/lights.hpp"
#include "host/stage/foveated.hpp"
#include "host/stage/kit.hpp"
#include "host/stage/light.hpp"
#include "host/stage/log_polar.hpp"
#include "host/stage/rings.hpp"
#include "host/stage/rrm.hpp"

namespace macula::method {

struct Size {
    std::uint32_t width = 0, height = 0; // pixels
};

// What a method gathers over frames, beyond what its own stages do; docs/methods/upscale.md.
struct TemporalOptions {
    float ratio = 1.8f;       // of a method "...+upscale": pixels of the picture for a rendered one
                              // along each axis, 1..4
    float frame_rate = 60.0f; // frames a second that the retention bias reckons with, 1..1000
    float sharpness = 0.5f;   // of the upscaled picture, 0..1
};

// Throws std::invalid_argument that names the option out of range.
void check(const TemporalOptions& options);

struct Options {
    frame::LightMode lights = frame::LightMode::point;
    stage::WeierOptions weier;
    float lowres_scale = 0.46f; // of method lowres: part of the pixels along each axis, 0..1
    stage::LogPolarOptions log_polar;
    TemporalOptions temporal;
    stage::RingOptions rings;
    stage::RrmOptions rrm;
    bool smoothed = false; // Method::make() says so to base(): samples are gathered over frames
};

struct Method {
    const char* name;
    const char* purpose; // one line
    // The stages of a frame by itself.
    frame::Graph (*base)(const stage::Kit& kit, const Options& options);
    // What follows them: "name+taa", "name+upscale", "name+taa+upscale".
    bool antialiased = false, upscaled = false;

    // Fewer samples, or older ones, away from the gaze.
    bool foveates() const;
    frame::Graph make(const stage::Kit& kit, const Options& options) const;
    // Pixels that are rendered for a picture of width x height.
    Size render_size(std::uint32_t width, std::uint32_t height, const TemporalOptions& t) const;
    // Frames after which the jitter of samples repeats; 0: it has none.
    std::uint32_t jitter_phases(std::uint32_t width, const TemporalOptions& t) const;
    // The resource that holds the picture.
    const char* picture() const;
};

std::span<const Method> methods();
// Throws std::invalid_argument that lists the known names.
const Method& find_method(std::string_view name);

// host/method/<name>.cpp
frame::Graph make_full(const stage::Kit& kit, const Options& options);
frame::Graph make_logpolar(const stage::Kit& kit, const Options& options);
frame::Graph make_logrect(const stage::Kit& kit, const Options& options);
frame::Graph make_lowres(const stage::Kit& kit, const Options& options);
frame::Graph make_lowres_rings(const stage::Kit& kit, const Options& options);
frame::Graph make_rrm(const stage::Kit& kit, const Options& options);
frame::Graph make_weier(const stage::Kit& kit, const Options& options);

// The stages of a method that samples a buffer uniform in a space around the gaze, and the foveal
// disk: kernel log-polar space, or log-rectilinear space if `rectangular`. `graph` has none yet.
frame::Graph make_log_space(frame::Graph graph, const stage::Kit& kit, const Options& options,
                            const stage::LogPolarOptions& shape, bool rectangular);

// The images that every method with a slot-ordered G-buffer can deliver besides its own colour:
// stages for within for_each_sample. Their names are those of render::image_formats().
std::vector<frame::Stage> surface_images(const stage::Kit& kit, const Options& options);

// The levels of reflected and refracted rays behind a shaded list and the blended layers before it,
// to be appended to it: none where the kit has no depth, or no layers. `spreads`, `rows`: as
// resolve_surface() and direct_light() of the primary rays take them. Returns the name of the
// resource that then holds each slot's whole colour.
std::string add_secondary_rays(std::vector<frame::Stage>& stages, const stage::Kit& kit,
                               const Options& options, const std::string& spreads = {},
                               stage::PlaceRows rows = {});

} // namespace macula::method
