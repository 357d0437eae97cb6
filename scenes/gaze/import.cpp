#include "scenes/gaze/import.hpp"

#include <cmath>
#include <stdexcept>

#include "scenes/gaze/import_formats.hpp"
#include "scenes/input.hpp"

namespace macula::scene {
namespace {

constexpr std::uint64_t kMaxFileBytes = 64 << 20;

struct Format {
    const char* name;
    const char* sign; // part of the first line by which it is told
    char separator;
    CsvTable::Header header;
    ImportedTrace (*import)(const CsvTable& table);
};

constexpr Format kFormats[] = {
    {"vive_pro_eye", "gaze_direct_L.x", ';', CsvTable::Header::present, import_vive_pro_eye},
    {"pico_neo3", "Combine Eye Gaze Vector. x", '\t', CsvTable::Header::present, import_pico_neo3},
    {"pupil_core", "gaze_timestamp", ',', CsvTable::Header::present, import_pupil_core},
    {"pupil_neon", "gaze x [px]", ',', CsvTable::Header::present, import_pupil_neon},
    {"tobii_pro_lab", "Gaze direction left X", '\t', CsvTable::Header::present,
     import_tobii_pro_lab},
    {"tobii_sdk", "left_gaze_origin_in_user_coordinate_system", ',', CsvTable::Header::present,
     import_tobii_sdk},
    {"head_quaternions", nullptr, ',', CsvTable::Header::absent, import_head_quaternions},
};

const Format& find_format(const std::string& name) {
    std::string known;
    for (const Format& format : kFormats) {
        if (name == format.name)
            return format;
        known += (known.empty() ? "" : ", ") + std::string(format.name);
    }
    throw std::invalid_argument("there is no trace format \"" + name + "\" (known: " + known + ")");
}

const Format& guess_format(const std::string& text, const std::string& file) {
    const std::string first = text.substr(0, text.find('\n'));
    for (const Format& format : kFormats)
        if (format.sign != nullptr && first.find(format.sign) != std::string::npos)
            return format;
    if (first.find_first_not_of("0123456789.,-+eE \t\r") == std::string::npos && !first.empty())
        return find_format("head_quaternions");
    throw SceneError(file + ":1: this is none of the formats that are known (--format names one)");
}

} // namespace

TraceBuilder::TraceBuilder(const CsvTable& table, std::string format) : table_(table) {
    trace_.format = std::move(format);
    trace_.gaze.name = trace_.head.name = table.name();
}

template <typename Sample>
void TraceBuilder::append(std::size_t row, Sample sample, std::vector<Sample>& samples) {
    if (!started_)
        start_ = sample.time_ns;
    started_ = true;
    if (__builtin_sub_overflow(sample.time_ns, start_, &sample.time_ns) ||
        sample.time_ns > (std::int64_t{1} << 62))
        table_.fail(row, "its time lies too far from the first row's");
    if (sample.time_ns < 0 || (!samples.empty() && sample.time_ns <= samples.back().time_ns))
        ++repeated_;
    else
        samples.push_back(sample);
}

void TraceBuilder::add(std::size_t row, GazeSample sample) {
    append(row, sample, trace_.gaze.samples);
}

void TraceBuilder::add(std::size_t row, HeadSample sample) {
    append(row, sample, trace_.head.samples);
}

ImportedTrace TraceBuilder::take() {
    if (!started_)
        throw SceneError(table_.name() + ": it has no samples");
    std::size_t invalid = 0;
    for (const GazeSample& sample : trace_.gaze.samples)
        invalid += sample.valid ? 0 : 1;
    if (repeated_ > 0)
        trace_.notes.push_back(std::to_string(repeated_) +
                               " samples left out: their time is not after the one before");
    if (invalid > 0)
        trace_.notes.push_back(std::to_string(invalid) + " of " +
                               std::to_string(trace_.gaze.samples.size()) +
                               " gaze samples are not valid");
    align_signs(trace_.head);
    return std::move(trace_);
}

std::optional<glm::dvec3> VectorColumns::read(const CsvTable& table, std::size_t row) const {
    glm::dvec3 v(0.0);
    for (int i = 0; i < 3; ++i) {
        const std::optional<double> value = table.number_if_any(row, column[i]);
        if (!value)
            return std::nullopt;
        if (!(std::fabs(*value) <= 1e6))
            table.fail(row, "a vector's component lies beyond 1e6");
        v[i] = sign[i] * *value;
    }
    return v;
}

VectorColumns vector_columns(const CsvTable& table, const std::string& prefix,
                             const std::array<double, 3>& sign, bool upper_case) {
    VectorColumns columns;
    for (std::size_t i = 0; i < 3; ++i) {
        columns.column[i] = table.column(prefix + (upper_case ? "XYZ" : "xyz")[i]);
        columns.sign[i] = sign[i];
    }
    return columns;
}

std::int64_t nanoseconds(const CsvTable& table, std::size_t row, std::size_t column,
                         double per_unit) {
    const double value = table.number(row, column) * per_unit;
    if (!(std::fabs(value) < 4e18))
        table.fail(row, "the time is out of range");
    return std::llround(value);
}

std::vector<std::string> trace_formats() {
    std::vector<std::string> names;
    for (const Format& format : kFormats)
        names.emplace_back(format.name);
    return names;
}

ImportedTrace import_trace(std::string text, const std::string& file, const std::string& format) {
    const Format& chosen = format.empty() ? guess_format(text, file) : find_format(format);
    // Exports of one program differ in their separator.
    const char separator =
        chosen.header == CsvTable::Header::present ? separator_of(text) : chosen.separator;
    const CsvTable table(std::move(text), file, separator, chosen.header);
    return chosen.import(table);
}

ImportedTrace import_trace(const std::filesystem::path& file, const std::string& format) {
    return import_trace(read_file(file, kMaxFileBytes), file.string(), format);
}

} // namespace macula::scene
