// Recorded gaze: the canonical CSV, and its replay. docs/gaze.md describes the format.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/gaze/source.hpp"

namespace macula::scene {

struct GazeRecording {
    std::string name;
    std::vector<GazeSample> samples; // strictly increasing times; invalid ones look straight ahead
};

// The header names the columns, in any order: time_ns, x y z (both eyes together), left_x left_y
// left_z right_x right_y right_z (each eye), valid (0 or 1), confidence (0..1). Time and one kind
// of direction are required. Throws SceneError with file and line.
GazeRecording parse_gaze_csv(std::string text, const std::string& file);
GazeRecording read_gaze_csv(const std::filesystem::path& file);
std::string to_csv(const GazeRecording& recording);

enum class AtEnd : std::uint8_t { hold, repeat };

// Its first sample is at time 0. After the last one it is held, or the recording starts again, one
// mean distance of samples later. Throws SceneError for a recording without samples.
GazePointer recorded_gaze(GazeRecording recording, AtEnd at_end);

// What importers and the canonical reader share: sets the direction from what is known of the eyes
// (their mean where only they are), all normalised; a sample without any direction is invalid.
void set_directions(GazeSample& sample, const std::optional<glm::dvec3>& both,
                    const std::optional<glm::dvec3>& left, const std::optional<glm::dvec3>& right);

} // namespace macula::scene
