// Exports of Pupil Labs' programs, by their documented columns.
#include <array>
#include <cmath>

#include "scenes/gaze/import_formats.hpp"

namespace macula::scene {
namespace {

std::optional<VectorColumns> columns_if_any(const CsvTable& table, const std::string& prefix,
                                            const std::array<double, 3>& sign) {
    if (!table.find(prefix + "x"))
        return std::nullopt;
    return vector_columns(table, prefix, sign);
}

// The point that both eyes look at, as a direction. Where their axes do not meet in front, the
// point is behind the camera and says nothing.
std::optional<glm::dvec3> read_point(const CsvTable& table, std::size_t row,
                                     const std::optional<VectorColumns>& columns) {
    const std::optional<glm::dvec3> point = columns ? columns->read(table, row) : std::nullopt;
    return point && point->z < 0.0 ? point : std::nullopt;
}

std::optional<glm::dvec3> read_if_any(const CsvTable& table, std::size_t row,
                                      const std::optional<VectorColumns>& columns) {
    return columns ? columns->read(table, row) : std::nullopt;
}

} // namespace

// gaze_positions.csv of Pupil Player: the scene camera's coordinates, x right, y down, z forward;
// eye 0 is the right one. The direction is that of gaze_point_3d where it lies in front, else of
// the eyes' normals.
ImportedTrace import_pupil_core(const CsvTable& table) {
    constexpr std::array kSign = {1.0, -1.0, -1.0};
    constexpr double kLeastConfidence = 0.6; // Pupil's own threshold for useful data
    const std::size_t time = table.column("gaze_timestamp");
    const std::size_t confidence = table.column("confidence");
    const auto point = columns_if_any(table, "gaze_point_3d_", kSign);
    const auto left = columns_if_any(table, "gaze_normal1_", kSign),
               right = columns_if_any(table, "gaze_normal0_", kSign);
    if (!point && !left && !right)
        throw SceneError(table.name() + ":1: there are no columns gaze_point_3d_x or "
                                        "gaze_normal0_x: it must be calibrated in 3D");
    TraceBuilder builder(table, "pupil_core");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        GazeSample sample;
        sample.time_ns = nanoseconds(table, row, time, 1e9);
        sample.confidence = table.number(row, confidence);
        if (!(sample.confidence >= 0.0 && sample.confidence <= 1.0))
            table.fail(row, "the confidence must be 0 to 1");
        sample.valid = sample.confidence >= kLeastConfidence;
        set_directions(sample, read_point(table, row, point), read_if_any(table, row, left),
                       read_if_any(table, row, right));
        builder.add(row, sample);
    }
    return builder.take();
}

// gaze.csv of Pupil Cloud (Neon, Invisible): degrees to the right and up in the scene camera's
// frame. `worn` is 1.0 or 0.0, in older files True or False; `blink id` is empty but in blinks.
ImportedTrace import_pupil_neon(const CsvTable& table) {
    const std::size_t time = table.column("timestamp [ns]");
    if (!table.find("azimuth [deg]"))
        throw SceneError(table.name() + ":1: there is no column 'azimuth [deg]': pixels alone give "
                                        "no direction; Pupil Cloud's export has both");
    const std::size_t azimuth = table.column("azimuth [deg]"),
                      elevation = table.column("elevation [deg]");
    const std::optional<std::size_t> worn = table.find("worn"), blink = table.find("blink id");
    TraceBuilder builder(table, "pupil_neon");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        GazeSample sample;
        sample.time_ns = table.integer(row, time);
        const std::optional<double> right = table.number_if_any(row, azimuth),
                                    up = table.number_if_any(row, elevation);
        if (right && up && !(std::fabs(*right) <= 180.0 && std::fabs(*up) <= 90.0))
            table.fail(row, "the azimuth must be within 180 and the elevation within 90 degrees");
        const std::string_view worn_text = worn ? table.text(row, *worn) : "1";
        sample.valid = worn_text != "0" && worn_text != "False" && worn_text != "0.0" &&
                       !(blink && table.number_if_any(row, *blink));
        set_directions(sample,
                       right && up ? std::optional(direction_of_angles(*right, *up)) : std::nullopt,
                       std::nullopt, std::nullopt);
        sample.confidence = sample.valid ? 1.0 : 0.0;
        builder.add(row, sample);
    }
    return builder.take();
}

} // namespace macula::scene
