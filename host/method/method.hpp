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
#include "host/stage/log_polar.hpp"

namespace macula::method {

struct Options {
    frame::LightMode lights = frame::LightMode::point;
    stage::WeierOptions weier;
    float lowres_scale = 0.46f; // of method lowres: part of the pixels along each axis, 0..1
    stage::LogPolarOptions log_polar;
};

struct Method {
    const char* name;
    const char* purpose; // one line
    frame::Graph (*make)(const stage::Kit& kit, const Options& options);
};

std::span<const Method> methods();
// Throws std::invalid_argument that lists the known names.
const Method& find_method(std::string_view name);

// host/method/<name>.cpp
frame::Graph make_full(const stage::Kit& kit, const Options& options);
frame::Graph make_logpolar(const stage::Kit& kit, const Options& options);
frame::Graph make_lowres(const stage::Kit& kit, const Options& options);
frame::Graph make_weier(const stage::Kit& kit, const Options& options);

// The images that every method with a slot-ordered G-buffer can deliver besides its own colour:
// stages for within for_each_sample. Their names are those of render::image_formats().
std::vector<frame::Stage> surface_images(const stage::Kit& kit, const Options& options);

// The levels of reflected and refracted rays behind a shaded list, to be appended to it: none where
// the kit has no depth. `spreads`: as resolve_surface() of the primary rays takes it. Returns the
// name of the resource that then holds each slot's whole colour.
std::string add_secondary_rays(std::vector<frame::Stage>& stages, const stage::Kit& kit,
                               const Options& options, const std::string& spreads = {});

} // namespace macula::method
