#include "scenes/head/recording.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "scenes/error.hpp"
#include "scenes/gaze/csv.hpp"
#include "scenes/head/pose.hpp"
#include "scenes/input.hpp"

namespace macula::scene {
namespace {

constexpr std::uint64_t kMaxFileBytes = 64 << 20;
constexpr double kMaxMetres = 1e6;

glm::dquat read_orientation(const CsvTable& table, std::size_t row,
                            const std::array<std::size_t, 4>& columns) {
    const glm::dquat q(table.number(row, columns[0]), table.number(row, columns[1]),
                       table.number(row, columns[2]), table.number(row, columns[3]));
    const double length = glm::length(q);
    if (!(length > 0.5 && length < 2.0))
        table.fail(row, "the quaternion is no rotation: its length is " + std::to_string(length));
    return q;
}

// Where the head faces without pitch and roll, as a rotation about y.
glm::dmat3 heading_of(const glm::dquat& orientation) {
    const glm::dvec3 forward = orientation * glm::dvec3(0.0, 0.0, -1.0);
    const glm::dvec3 up = orientation * glm::dvec3(0.0, 1.0, 0.0);
    // Looking straight up or down, the top of the head says it.
    glm::dvec3 flat(forward.x, 0.0, forward.z);
    if (glm::length(flat) < 1e-3)
        flat = glm::dvec3(up.x, 0.0, up.z) * (forward.y > 0.0 ? -1.0 : 1.0);
    if (glm::length(flat) < 1e-9)
        return glm::dmat3(1.0);
    const glm::dvec3 back = -glm::normalize(flat), y(0.0, 1.0, 0.0);
    return {glm::cross(y, back), y, back};
}

} // namespace

HeadRecording parse_head_csv(std::string text, const std::string& file) {
    const CsvTable table(std::move(text), file, ',', CsvTable::Header::present);
    const std::size_t time = table.column("time_ns");
    const std::array quaternion = {table.column("quat_w"), table.column("quat_x"),
                                   table.column("quat_y"), table.column("quat_z")};
    std::array<std::size_t, 3> position{};
    const bool has_position = table.find("pos_x").has_value();
    if (has_position)
        position = {table.column("pos_x"), table.column("pos_y"), table.column("pos_z")};
    HeadRecording recording{file, {}};
    for (std::size_t row = 0; row < table.rows(); ++row) {
        HeadSample sample;
        sample.time_ns = table.integer(row, time);
        if (sample.time_ns < 0 || sample.time_ns > (std::int64_t{1} << 62))
            table.fail(row, "the time must be 0 to 2^62");
        if (row > 0 && sample.time_ns <= recording.samples.back().time_ns)
            table.fail(row, "its time is not after that of the row before");
        sample.orientation = read_orientation(table, row, quaternion);
        for (int i = 0; has_position && i < 3; ++i) {
            sample.position[i] = table.number(row, position[static_cast<std::size_t>(i)]);
            if (!(std::fabs(sample.position[i]) <= kMaxMetres))
                table.fail(row, "the position lies more than 1e6 metres away");
        }
        recording.samples.push_back(sample);
    }
    align_signs(recording);
    return recording;
}

HeadRecording read_head_csv(const std::filesystem::path& file) {
    return parse_head_csv(read_file(file, kMaxFileBytes), file.string());
}

std::string to_csv(const HeadRecording& recording) {
    std::string text = "time_ns,pos_x,pos_y,pos_z,quat_w,quat_x,quat_y,quat_z\n";
    for (const HeadSample& s : recording.samples) {
        std::array<char, 256> line{};
        std::snprintf(line.data(), line.size(), "%lld,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n",
                      static_cast<long long>(s.time_ns), s.position.x, s.position.y, s.position.z,
                      s.orientation.w, s.orientation.x, s.orientation.y, s.orientation.z);
        text += line.data();
    }
    return text;
}

void align_signs(HeadRecording& recording) {
    glm::dquat last(1.0, 0.0, 0.0, 0.0);
    for (HeadSample& sample : recording.samples) {
        sample.orientation = glm::normalize(sample.orientation);
        if (glm::dot(sample.orientation, last) < 0.0)
            sample.orientation = -sample.orientation;
        last = sample.orientation;
    }
}

glm::dquat orientation_of_unity_angles(double x, double y, double z) {
    const glm::dvec3 radians = glm::radians(glm::dvec3(x, y, z));
    const glm::dquat left_handed = glm::angleAxis(radians.y, glm::dvec3(0.0, 1.0, 0.0)) *
                                   glm::angleAxis(radians.x, glm::dvec3(1.0, 0.0, 0.0)) *
                                   glm::angleAxis(radians.z, glm::dvec3(0.0, 0.0, 1.0));
    // Mirrored along z.
    return {left_handed.w, -left_handed.x, -left_handed.y, left_handed.z};
}

RecordedHead::RecordedHead(HeadRecording recording) : recording_(std::move(recording)) {
    if (recording_.samples.empty())
        throw SceneError(recording_.name + ": it has no samples");
    align_signs(recording_);
    body_from_room_ = glm::transpose(heading_of(recording_.samples.front().orientation));
}

std::int64_t RecordedHead::length_ns() const {
    return recording_.samples.back().time_ns - recording_.samples.front().time_ns;
}

HeadSample RecordedHead::at(std::int64_t time_ns) const {
    const auto& samples = recording_.samples;
    const std::int64_t start = samples.front().time_ns;
    const std::int64_t t = start + std::clamp<std::int64_t>(time_ns, 0, length_ns());
    const auto after = std::upper_bound(
        samples.begin(), samples.end(), t,
        [](std::int64_t wanted, const HeadSample& sample) { return wanted < sample.time_ns; });
    HeadSample result = *std::prev(after);
    if (after != samples.end()) {
        const double part = static_cast<double>(t - result.time_ns) /
                            static_cast<double>(after->time_ns - result.time_ns);
        result.position = glm::mix(result.position, after->position, part);
        result.orientation = glm::slerp(result.orientation, after->orientation, part);
    }
    result.time_ns = t - start;
    return result;
}

Camera RecordedHead::on(const Camera& base, std::int64_t time_ns, double units_per_metre) const {
    const HeadSample head = at(time_ns);
    const glm::dmat3 axes = world_from_head(base);
    const glm::dvec3 right = axes[0];
    glm::dvec3 up = glm::normalize(glm::dvec3(base.up));
    if (std::fabs(glm::dot(right, up)) > 1e-6) // a view along `up`
        up = axes[1];
    const glm::dmat3 world_from_body(right, up, glm::cross(right, up));
    const glm::dmat3 turned = world_from_body * body_from_room_ * glm::mat3_cast(head.orientation);
    const glm::dvec3 moved =
        body_from_room_ * (head.position - recording_.samples.front().position);
    const double distance = glm::length(glm::dvec3(base.target) - glm::dvec3(base.eye));
    const glm::dvec3 eye = glm::dvec3(base.eye) + world_from_body * moved * units_per_metre;
    Camera camera = base;
    camera.eye = glm::vec3(eye);
    camera.target = glm::vec3(eye - turned[2] * distance);
    camera.up = glm::vec3(turned[1]);
    return camera;
}

} // namespace macula::scene
