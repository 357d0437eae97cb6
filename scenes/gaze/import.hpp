// Recordings of other programs, turned into ours. docs/gaze.md names the columns that are read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/gaze/recording.hpp"
#include "scenes/head/recording.hpp"

namespace macula::scene {

struct ImportedTrace {
    std::string format;
    GazeRecording gaze;             // without samples when the file has only the head
    HeadRecording head;             // without samples when the file has only the gaze
    std::vector<std::string> notes; // what was left out, with counts
};

// "vive_pro_eye", "pico_neo3", "head_quaternions", "pupil_core", "pupil_neon", "tobii_pro_lab",
// "tobii_sdk".
std::vector<std::string> trace_formats();

// `format` empty: told by the first line. Times start at 0 and gaze and head share them; rows whose
// time does not go on are left out with a note. Throws SceneError naming file and line,
// std::invalid_argument for an unknown format.
ImportedTrace import_trace(std::string text, const std::string& file, const std::string& format);
ImportedTrace import_trace(const std::filesystem::path& file, const std::string& format);

} // namespace macula::scene
