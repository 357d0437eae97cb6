/// The options of `macula compare`, and the view that they describe.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/metric/score.hpp"
#include "scenes/gaze/source.hpp"

namespace CLI {
class App;
}

namespace macula::app {

struct CompareOptions {
    std::vector<std::string> pictures; // the reference first
    std::optional<double> pixels_per_degree;
    std::string display, eye = "mono", gaze, tracker, frames, motion, heat_map, foveated_heat_map,
                         exposures, tone_mapper = "aces";
    bool hdr = false, still = false, json = false;

    void add_to(CLI::App& command);
};

/// Display, eye and gaze of a comparison.
class CompareView {
  public:
    /// Throws std::invalid_argument that names the option, scene::SceneError of files.
    CompareView(const CompareOptions& options, std::uint32_t width, std::uint32_t height);

    /// --ppd, else the display's on the eye's axis, else the default.
    double pixels_per_degree() const { return pixels_per_degree_; }
    const char* pixels_per_degree_source() const { return source_; }
    const scene::Display& display() const { return display_; }
    bool has_gaze() const { return gaze_ != nullptr; }
    /// Where the eye looks in a frame. Needs a gaze.
    metric::View at(std::uint32_t frame);

  private:
    scene::Display display_;
    scene::Eye eye_ = scene::Eye::mono;
    scene::GazePointer gaze_;
    double pixels_per_degree_ = 0.0;
    const char* source_ = "";
};

/// Throws std::invalid_argument that names the option.
metric::ScoreOptions score_options(const CompareOptions& options, double pixels_per_degree);

} // namespace macula::app
