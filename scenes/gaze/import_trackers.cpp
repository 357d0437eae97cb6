// Exports of eye trackers' own programs, by their documented columns.
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

std::optional<glm::dvec3> read_if_any(const CsvTable& table, std::size_t row,
                                      const std::optional<VectorColumns>& columns) {
    return columns ? columns->read(table, row) : std::nullopt;
}

// Of the time column's unit in brackets; without one, microseconds.
double nanoseconds_per_unit(const CsvTable& table, std::size_t column) {
    const std::string_view title = table.title(column);
    if (title.find("[ms]") != std::string_view::npos)
        return 1e6;
    if (title.find("[s]") != std::string_view::npos)
        return 1e9;
    if (title.find("[ns]") != std::string_view::npos)
        return 1.0;
    return 1e3;
}

// Tobii's directions come in the glasses' coordinates (x left, y up, z forward), a screen tracker's
// (x right, y up, z towards the user) or the display's (DACS: x right, y down). Forward tells the
// first two apart.
std::array<double, 3> tobii_signs(const CsvTable& table, std::size_t column_z) {
    double sum = 0.0;
    for (std::size_t row = 0; row < table.rows(); ++row)
        sum += table.number_if_any(row, column_z).value_or(0.0);
    const bool z_forward = sum > 0.0;
    if (table.title(column_z).find("DACS") != std::string_view::npos)
        return {1.0, -1.0, z_forward ? -1.0 : 1.0};
    return z_forward ? std::array{-1.0, 1.0, -1.0} : std::array{1.0, 1.0, 1.0};
}

bool says_invalid(const CsvTable& table, std::size_t row, std::optional<std::size_t> column) {
    return column && table.text(row, *column) != "Valid";
}

} // namespace

// gaze_positions.csv of Pupil Player: the scene camera's coordinates, x right, y down, z forward;
// eye 0 is the right one. The direction is that of gaze_point_3d, else of the eyes' normals.
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
        set_directions(sample, read_if_any(table, row, point), read_if_any(table, row, left),
                       read_if_any(table, row, right));
        builder.add(row, sample);
    }
    return builder.take();
}

// gaze.csv of Neon and of Pupil Cloud: degrees to the right and up in the scene camera's frame.
ImportedTrace import_pupil_neon(const CsvTable& table) {
    const std::size_t time = table.column("timestamp [ns]");
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
                       !(blink && table.number_if_any(row, *blink).value_or(0.0) > 0.0);
        set_directions(sample,
                       right && up ? std::optional(direction_of_angles(*right, *up)) : std::nullopt,
                       std::nullopt, std::nullopt);
        sample.confidence = sample.valid ? 1.0 : 0.0;
        builder.add(row, sample);
    }
    return builder.take();
}

// The data export of Tobii Pro Lab. Rows of other sensors are passed over.
ImportedTrace import_tobii_pro_lab(const CsvTable& table) {
    const std::size_t time = table.column("Recording timestamp");
    const double per_unit = nanoseconds_per_unit(table, time);
    const std::array<double, 3> sign = tobii_signs(table, table.column("Gaze direction left Z"));
    const VectorColumns left = vector_columns(table, "Gaze direction left ", sign, true),
                        right = vector_columns(table, "Gaze direction right ", sign, true);
    const auto sensor = table.find("Sensor"), valid_left = table.find("Validity left"),
               valid_right = table.find("Validity right");
    TraceBuilder builder(table, "tobii_pro_lab");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        if (sensor && table.text(row, *sensor) != "Eye Tracker")
            continue;
        GazeSample sample;
        sample.time_ns = nanoseconds(table, row, time, per_unit);
        set_directions(sample, std::nullopt,
                       says_invalid(table, row, valid_left) ? std::nullopt : left.read(table, row),
                       says_invalid(table, row, valid_right) ? std::nullopt
                                                             : right.read(table, row));
        sample.confidence = 0.5 * (sample.left ? 1.0 : 0.0) + 0.5 * (sample.right ? 1.0 : 0.0);
        builder.add(row, sample);
    }
    return builder.take();
}

} // namespace macula::scene
