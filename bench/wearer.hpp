// Whose eyes and head a benchmark follows.
#pragma once

#include <optional>
#include <string>

#include "bench/quality.hpp"
#include "scenes/gaze/source.hpp"
#include "scenes/head/recording.hpp"

namespace macula::bench {

struct Wearer {
    scene::GazePointer gaze;
    std::optional<scene::RecordedHead> head;
    std::string gaze_name, head_name; // for people; no folders
};

// By default the first found of ../traces beside the scene folders holds kDefaultTrace, whose gaze
// and head are taken; without it a synthetic observer on the scene's path. Throws
// std::invalid_argument, scene::SceneError.
inline constexpr const char* kDefaultTrace = "vive_pro_eye_head_gaze/TESTNA01_360VR_Fist3.csv";
Wearer wearer_of(const QualityOptions& options, const scene::Display& display);

} // namespace macula::bench
