// Recorded head motion: the canonical CSV, and its replay on top of a camera's path.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "scenes/scene.hpp"

namespace macula::scene {

struct HeadSample {
    std::int64_t time_ns = 0;
    glm::dvec3 position{0.0};                   // metres
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0}; // room from head: x right, y up, -z forward
};

struct HeadRecording {
    std::string name;
    std::vector<HeadSample> samples; // strictly increasing times, unit quaternions
};

// The header names the columns, in any order: time_ns, quat_w quat_x quat_y quat_z and, optionally,
// pos_x pos_y pos_z in metres. Throws SceneError with file and line.
HeadRecording parse_head_csv(std::string text, const std::string& file);
HeadRecording read_head_csv(const std::filesystem::path& file);
std::string to_csv(const HeadRecording& recording);

// Turns quaternions so that neighbours have the same sign: q and -q are one orientation, but a path
// between them that takes the long way round is a jolt. Normalises them.
void align_signs(HeadRecording& recording);

// Of Unity's Euler angles in degrees (left-handed, +z forward; about z, then x, then y), which may
// wrap around at 360, as a rotation of head space.
glm::dquat orientation_of_unity_angles(double x, double y, double z);

// Replays a recording: poses between samples are interpolated, beyond the ends held.
class RecordedHead {
  public:
    explicit RecordedHead(HeadRecording recording); // throws SceneError without samples

    // `time_ns` counts from the first sample.
    HeadSample at(std::int64_t time_ns) const;
    std::int64_t length_ns() const;

    // The head at that time on a body that `base` carries: the body stands at base.eye and faces
    // where base looks, without its pitch. The recording's first place and heading become the
    // body's; its pitch, its roll and all motion are kept.
    Camera on(const Camera& base, std::int64_t time_ns, double units_per_metre) const;

  private:
    HeadRecording recording_;
    glm::dmat3 body_from_room_;
};

} // namespace macula::scene
