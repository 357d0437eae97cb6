/// Display, eyes, gaze and head of a rendering: what the user asked for, and frame by frame what
/// each eye sees and where it looks. docs/displays.md and docs/gaze.md give the syntax.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/frame/frame_params.hpp"
#include "scenes/gaze/source.hpp"
#include "scenes/head/recording.hpp"
#include "scenes/scene.hpp"

namespace CLI {
class App;
}

namespace macula::app {

class SceneDepth;

struct ViewOptions {
    std::string display; // empty: the scene's; without one, or "none", the camera's field of view
    std::string size;    // WxH; empty: the display's, or 640x480
    std::string eyes = "mono", tracker, head;
    bool distort = false; // warp the pictures for the display's lens
    std::string gaze;     // empty: the scene's; without one, or "none", along the camera's axis

    void add_to(CLI::App& command);
};

/// Display and gaze as the scene file prefers them, where the command line says nothing; "none"
/// becomes empty.
void take_views_of(const scene::Scene& scene, ViewOptions& options);

/// --size, or what is given without it: pixels. Throws std::invalid_argument.
std::pair<std::uint32_t, std::uint32_t> size_of(const ViewOptions& options, std::uint32_t width,
                                                std::uint32_t height);

/// The display with the size that is asked for; without a display one eye that sees what `camera`
/// does. Throws std::invalid_argument and scene::SceneError.
scene::Display display_of(const ViewOptions& options, const scene::Camera& camera);

/// "mono", "left", "right" or "both". Throws std::invalid_argument.
std::vector<scene::Eye> eyes_of(const ViewOptions& options);

/// True where --head names a recording (.csv) instead of a path.
bool head_is_recorded(const ViewOptions& options);

/// The field of view as the renderer takes it.
frame::Tangents tangents_of(const scene::EyeView& eye);

/// One eye in one frame.
struct EyeFrame {
    scene::Camera camera;
    frame::Gaze gaze;
    scene::GazeSample sample;
};

class Views {
  public:
    /// The scene must outlive it. Throws std::invalid_argument that names the option, and
    /// scene::SceneError for what files hold.
    Views(const ViewOptions& options, const scene::Scene& scene);
    ~Views();

    const scene::Display& display() const { return display_; }
    /// One eye in one frame. Both eyes of a frame see one gaze sample.
    EyeFrame at(std::uint32_t frame, scene::Eye eye);
    /// What the gaze comes from; empty: along the camera's axis.
    std::string gaze_source() const;
    /// What a live source received so far; else empty.
    std::string gaze_status() const;

  private:
    scene::Camera head_at(std::int64_t time_ns) const;
    double depth(std::int64_t time_ns, const glm::dvec3& direction);
    std::int64_t time_ns(std::uint32_t frame) const;
    const scene::GazeSample& sample_at(std::uint32_t frame);

    const scene::Scene& scene_;
    scene::Display display_;
    std::optional<scene::RecordedHead> head_;
    scene::GazePointer gaze_;           // none: along the camera's axis
    std::unique_ptr<SceneDepth> depth_; // once a gaze source asks
    std::optional<std::uint32_t> sampled_frame_;
    scene::GazeSample sample_;
};

} // namespace macula::app
