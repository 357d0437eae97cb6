// Exports of Tobii's programs, by their documented columns.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "scenes/gaze/import_formats.hpp"

namespace macula::scene {
namespace {

constexpr double kMicrosecond = 1e3, kMillisecond = 1e6; // ns

// The time column's unit in brackets. Older exports give none; then the step from one sample to the
// next tells: trackers measure 30 to 1200 times a second, 1 to 33 ms or 833 to 33,333 us apart.
double nanoseconds_per_unit(const CsvTable& table, std::size_t column,
                            const std::vector<std::size_t>& rows) {
    constexpr std::pair<const char*, double> kUnits[] = {
        {"[ms]", kMillisecond}, {"[s]", 1e9}, {"[ns]", 1.0}};
    const std::string_view title = table.title(column);
    for (const auto& [unit, nanoseconds] : kUnits)
        if (title.find(unit) != std::string_view::npos)
            return nanoseconds;
    if (title.find('[') != std::string_view::npos || rows.size() < 2)
        return kMicrosecond;
    std::vector<double> steps;
    for (std::size_t i = 1; i < rows.size(); ++i)
        steps.push_back(table.number(rows[i], column) - table.number(rows[i - 1], column));
    std::nth_element(steps.begin(), steps.begin() + std::ptrdiff_t(steps.size() / 2), steps.end());
    return steps[steps.size() / 2] < 500.0 ? kMillisecond : kMicrosecond;
}

// Directions come in the glasses' coordinates (x left, y up, z forward), a screen tracker's (x
// right, y up, z towards the user) or the display's (DACS: x right, y down). Forward tells the
// first two apart; older exports name DACS with the eyes' positions only.
std::array<double, 3> signs_of(const CsvTable& table, std::size_t column_z) {
    double sum = 0.0;
    for (std::size_t row = 0; row < table.rows(); ++row)
        sum += table.number_if_any(row, column_z).value_or(0.0);
    const bool z_forward = sum > 0.0;
    bool of_display = false;
    for (std::size_t column = 0; column < table.columns(); ++column)
        of_display = of_display || table.title(column).find("DACS") != std::string_view::npos;
    if (of_display)
        return {1.0, -1.0, z_forward ? -1.0 : 1.0};
    return z_forward ? std::array{-1.0, 1.0, -1.0} : std::array{1.0, 1.0, 1.0};
}

bool says_valid(const CsvTable& table, std::size_t row, std::optional<std::size_t> column) {
    const std::string_view word = column ? table.text(row, *column) : "Valid";
    if (word != "Valid" && word != "Invalid" && !word.empty())
        table.fail(row, "a validity is neither \"Valid\" nor \"Invalid\" but \"" +
                            std::string(word) + '"');
    return word == "Valid";
}

// A vector in one cell, "(x, y, z)"; nothing where a component is nan.
std::optional<glm::dvec3> read_tuple(const CsvTable& table, std::size_t row, std::size_t column) {
    std::string_view text = table.text(row, column);
    if (text.empty())
        return std::nullopt;
    const auto fail = [&] {
        table.fail(row, "\"" + std::string(table.text(row, column)) +
                            "\" is no vector (x, y, z) of numbers up to 1e6");
    };
    if (text.size() < 2 || text.front() != '(' || text.back() != ')')
        fail();
    text = text.substr(1, text.size() - 2);
    glm::dvec3 v(0.0);
    for (int i = 0; i < 3; ++i) {
        text.remove_prefix(std::min(text.find_first_not_of(" ,"), text.size()));
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), v[i]);
        if (error != std::errc())
            fail();
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    }
    if (std::isnan(v.x) || std::isnan(v.y) || std::isnan(v.z))
        return std::nullopt;
    if (!text.empty() || !(std::fabs(v.x) <= 1e6 && std::fabs(v.y) <= 1e6 && std::fabs(v.z) <= 1e6))
        fail();
    return v;
}

// A member of the SDK's gaze data, in one cell or in three: NAME, NAME_x.. or NAME_0..
class SdkVector {
  public:
    SdkVector(const CsvTable& table, const std::string& name) : tuple_(table.find(name)) {
        if (tuple_)
            return;
        const char* ends = table.find(name + "_0") ? "012" : "xyz";
        for (std::size_t i = 0; i < 3; ++i)
            columns_.column[i] = table.column(name + '_' + ends[i]);
    }

    std::optional<glm::dvec3> read(const CsvTable& table, std::size_t row) const {
        return tuple_ ? read_tuple(table, row, *tuple_) : columns_.read(table, row);
    }

  private:
    std::optional<std::size_t> tuple_;
    VectorColumns columns_;
};

struct SdkEye {
    SdkVector origin, point;
    std::optional<std::size_t> origin_valid, point_valid;

    SdkEye(const CsvTable& table, const std::string& side)
        : origin(table, side + "_gaze_origin_in_user_coordinate_system"),
          point(table, side + "_gaze_point_in_user_coordinate_system"),
          origin_valid(table.find(side + "_gaze_origin_validity")),
          point_valid(table.find(side + "_gaze_point_validity")) {}

    static bool is_valid(const CsvTable& table, std::size_t row,
                         const std::optional<std::size_t>& column) {
        const std::string_view word = column ? table.text(row, *column) : "1";
        return word == "1" || word == "1.0" || word == "True";
    }

    std::optional<glm::dvec3> direction(const CsvTable& table, std::size_t row) const {
        if (!is_valid(table, row, origin_valid) || !is_valid(table, row, point_valid))
            return std::nullopt;
        const auto from = origin.read(table, row), to = point.read(table, row);
        return from && to ? std::optional(*to - *from) : std::nullopt;
    }
};

void add_eyes(TraceBuilder& builder, std::size_t row, GazeSample sample,
              const std::optional<glm::dvec3>& left, const std::optional<glm::dvec3>& right) {
    set_directions(sample, std::nullopt, left, right);
    sample.confidence = 0.5 * (sample.left ? 1.0 : 0.0) + 0.5 * (sample.right ? 1.0 : 0.0);
    builder.add(row, sample);
}

} // namespace

// The data export of Tobii Pro Lab. Rows of other sensors are passed over.
ImportedTrace import_tobii_pro_lab(const CsvTable& table) {
    const std::size_t time = table.column("Recording timestamp");
    const std::array<double, 3> sign = signs_of(table, table.column("Gaze direction left Z"));
    const VectorColumns left = vector_columns(table, "Gaze direction left ", sign, true),
                        right = vector_columns(table, "Gaze direction right ", sign, true);
    const auto sensor = table.find("Sensor"), valid_left = table.find("Validity left"),
               valid_right = table.find("Validity right");
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < table.rows(); ++row)
        if (!sensor || table.text(row, *sensor) == "Eye Tracker")
            rows.push_back(row);
    const double per_unit = nanoseconds_per_unit(table, time, rows);
    TraceBuilder builder(table, "tobii_pro_lab");
    for (const std::size_t row : rows) {
        GazeSample sample;
        sample.time_ns = nanoseconds(table, row, time, per_unit);
        add_eyes(builder, row, sample,
                 says_valid(table, row, valid_left) ? left.read(table, row) : std::nullopt,
                 says_valid(table, row, valid_right) ? right.read(table, row) : std::nullopt);
    }
    return builder.take();
}

// The gaze data of the Tobii Pro SDK as a table. The user's coordinates, in mm from the tracker: x
// to the user's right, y up, z towards the user; so a point less an origin is in head space.
ImportedTrace import_tobii_sdk(const CsvTable& table) {
    const std::size_t time = table.find("device_time_stamp") ? table.column("device_time_stamp")
                                                             : table.column("system_time_stamp");
    const SdkEye left(table, "left"), right(table, "right");
    TraceBuilder builder(table, "tobii_sdk");
    for (std::size_t row = 0; row < table.rows(); ++row) {
        GazeSample sample;
        sample.time_ns = nanoseconds(table, row, time, kMicrosecond);
        add_eyes(builder, row, sample, left.direction(table, row), right.direction(table, row));
    }
    return builder.take();
}

} // namespace macula::scene
