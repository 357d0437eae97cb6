// Recordings of research software on headsets, by the notes that were published with them.
#include <array>
#include <cmath>

#include "scenes/gaze/import_formats.hpp"

namespace macula::scene {
namespace {

// Unity: left-handed, x right, y up, +z forward, in metres.
HeadSample unity_head(const CsvTable& table, std::size_t row, std::int64_t time_ns,
                      const VectorColumns& position, const VectorColumns& rotation) {
    const std::optional<glm::dvec3> p = position.read(table, row), r = rotation.read(table, row);
    if (!p || !r)
        table.fail(row, "the head's position or rotation is missing");
    return {time_ns, *p, orientation_of_unity_angles(r->x, r->y, r->z)};
}

// Ticks of 100 ns in 18 digits: more than a double holds.
std::int64_t ticks(const CsvTable& table, std::size_t row, std::size_t column, std::int64_t first) {
    std::int64_t time = 0;
    if (__builtin_sub_overflow(table.integer(row, column), first, &time) ||
        __builtin_mul_overflow(time, std::int64_t{100}, &time))
        table.fail(row, "the time is out of range");
    return time;
}

} // namespace

// Gaze in the head's frame with x to the wearer's left, y up, +z forward; an eye counts where its
// bit mask says that everything is valid (31).
ImportedTrace import_vive_pro_eye(const CsvTable& table) {
    constexpr std::int64_t kAllValid = 31;
    constexpr std::array kSign = {-1.0, 1.0, -1.0};
    const std::size_t time = table.column("time(100ns)");
    const std::size_t valid_left = table.column("eye_valid_L"),
                      valid_right = table.column("eye_valid_R");
    const VectorColumns left = vector_columns(table, "gaze_direct_L.", kSign),
                        right = vector_columns(table, "gaze_direct_R.", kSign);
    const VectorColumns position = vector_columns(table, "helmet_pos_", {1.0, 1.0, -1.0}),
                        rotation = vector_columns(table, "helmet_rot_", {1.0, 1.0, 1.0});
    TraceBuilder builder(table, "vive_pro_eye");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        GazeSample sample;
        sample.time_ns = ticks(table, row, time, table.integer(0, time));
        const bool has_left = table.integer(row, valid_left) == kAllValid,
                   has_right = table.integer(row, valid_right) == kAllValid;
        set_directions(sample, std::nullopt, has_left ? left.read(table, row) : std::nullopt,
                       has_right ? right.read(table, row) : std::nullopt);
        sample.confidence = 0.5 * (sample.left ? 1.0 : 0.0) + 0.5 * (sample.right ? 1.0 : 0.0);
        builder.add(row, unity_head(table, row, sample.time_ns, position, rotation));
        builder.add(row, sample);
    }
    return builder.take();
}

// Combined gaze in the head's frame with x right, y up, +z forward. An eye's status of 0 says that
// its tracking was lost.
ImportedTrace import_pico_neo3(const CsvTable& table) {
    const std::size_t time = table.column("Timeline");
    const std::size_t status_left = table.column("Left Eye Pose Status"),
                      status_right = table.column("Right Eye Pose Status");
    const VectorColumns gaze = vector_columns(table, "Combine Eye Gaze Vector. ", {1.0, 1.0, -1.0});
    const VectorColumns position = vector_columns(table, "Head Position. ", {1.0, 1.0, -1.0}),
                        rotation = vector_columns(table, "Head Rotation. ", {1.0, 1.0, 1.0});
    TraceBuilder builder(table, "pico_neo3");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        GazeSample sample;
        sample.time_ns = nanoseconds(table, row, time, 1e9);
        const double eyes = (table.integer(row, status_left) != 0 ? 0.5 : 0.0) +
                            (table.integer(row, status_right) != 0 ? 0.5 : 0.0);
        sample.valid = eyes > 0.0;
        set_directions(sample, gaze.read(table, row), std::nullopt, std::nullopt);
        sample.confidence = sample.valid ? eyes : 0.0;
        builder.add(row, unity_head(table, row, sample.time_ns, position, rotation));
        builder.add(row, sample);
    }
    return builder.take();
}

// Seconds, a quaternion x y z w, and where that looks: x right, y down, +z forward, so a half turn
// about x leads to head space.
ImportedTrace import_head_quaternions(const CsvTable& table) {
    if (table.columns() != 8 && table.columns() != 5)
        table.fail(0, "8 values were expected (time, quaternion x y z w, view x y z), or the "
                      "first 5 of them");
    TraceBuilder builder(table, "head_quaternions");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        HeadSample sample;
        sample.time_ns = nanoseconds(table, row, 0, 1e9);
        sample.orientation = {table.number(row, 4), table.number(row, 1), -table.number(row, 2),
                              -table.number(row, 3)};
        const double length = glm::length(sample.orientation);
        if (!(length > 0.5 && length < 2.0))
            table.fail(row,
                       "the quaternion is no rotation: its length is " + std::to_string(length));
        builder.add(row, sample);
    }
    return builder.take();
}

} // namespace macula::scene
