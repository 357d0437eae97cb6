#include "scenes/gaze/recording.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "scenes/gaze/csv.hpp"
#include "scenes/input.hpp"

namespace macula::scene {
namespace {

constexpr std::uint64_t kMaxFileBytes = 64 << 20;

using Columns = std::optional<std::array<std::size_t, 3>>;

Columns find_vector(const CsvTable& table, const std::string& prefix) {
    if (!table.find(prefix + "x") && !table.find(prefix + "y") && !table.find(prefix + "z"))
        return std::nullopt;
    return std::array{table.column(prefix + "x"), table.column(prefix + "y"),
                      table.column(prefix + "z")};
}

std::optional<glm::dvec3> read_vector(const CsvTable& table, std::size_t row,
                                      const Columns& columns) {
    glm::dvec3 v(0.0);
    if (!columns)
        return std::nullopt;
    for (int i = 0; i < 3; ++i) {
        const auto value = table.number_if_any(row, (*columns)[static_cast<std::size_t>(i)]);
        if (!value)
            return std::nullopt;
        if (!(std::fabs(*value) <= 1e6))
            table.fail(row, "a direction's component lies beyond 1e6");
        v[i] = *value;
    }
    return v;
}

std::optional<glm::dvec3> unit(const std::optional<glm::dvec3>& v) {
    if (!v || !(glm::length(*v) > 1e-6))
        return std::nullopt;
    return glm::normalize(*v);
}

std::string vector_text(const std::optional<glm::dvec3>& v) {
    if (!v)
        return ",,";
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "%.9g,%.9g,%.9g", v->x, v->y, v->z);
    return text.data();
}

class Recorded : public GazeSource {
  public:
    Recorded(GazeRecording recording, AtEnd at_end)
        : recording_(std::move(recording)), at_end_(at_end) {
        const auto& s = recording_.samples;
        if (s.empty())
            throw SceneError(recording_.name + ": it has no samples");
        const std::int64_t length = s.back().time_ns - s.front().time_ns;
        const auto gaps = static_cast<std::int64_t>(s.size()) - 1;
        period_ = length + (gaps > 0 ? std::max<std::int64_t>(length / gaps, 1) : 1);
    }

    GazeSample at(std::int64_t time_ns) override {
        const auto& samples = recording_.samples;
        std::int64_t lap = 0;
        if (at_end_ == AtEnd::repeat && time_ns >= period_)
            lap = time_ns / period_ * period_;
        const std::int64_t start = samples.front().time_ns;
        auto after = std::upper_bound(
            samples.begin(), samples.end(), std::max<std::int64_t>(time_ns - lap, 0) + start,
            [](std::int64_t t, const GazeSample& sample) { return t < sample.time_ns; });
        GazeSample sample = *std::prev(after);
        sample.time_ns += lap - start;
        return sample;
    }

    std::string describe() const override { return "recording " + recording_.name; }

  private:
    GazeRecording recording_;
    AtEnd at_end_;
    std::int64_t period_ = 1;
};

} // namespace

void set_directions(GazeSample& sample, const std::optional<glm::dvec3>& both,
                    const std::optional<glm::dvec3>& left, const std::optional<glm::dvec3>& right) {
    sample.left = unit(left);
    sample.right = unit(right);
    std::optional<glm::dvec3> direction = unit(both);
    if (!direction && sample.left && sample.right)
        direction = unit(*sample.left + *sample.right);
    else if (!direction)
        direction = sample.left ? sample.left : sample.right;
    sample.valid = sample.valid && direction.has_value();
    if (!sample.valid) {
        sample.left = sample.right = std::nullopt;
        direction = glm::dvec3(0.0, 0.0, -1.0);
    }
    sample.direction = *direction;
}

GazeRecording parse_gaze_csv(std::string text, const std::string& file) {
    const CsvTable table(std::move(text), file, ',', CsvTable::Header::present);
    const std::size_t time = table.column("time_ns");
    const Columns both = find_vector(table, ""), left = find_vector(table, "left_"),
                  right = find_vector(table, "right_");
    if (!both && !left && !right)
        throw SceneError(file + ":1: there is no direction: x, y, z or left_x ... right_z");
    const auto valid = table.find("valid"), confidence = table.find("confidence");
    GazeRecording recording{file, {}};
    for (std::size_t row = 0; row < table.rows(); ++row) {
        GazeSample sample;
        sample.time_ns = table.integer(row, time);
        if (sample.time_ns < 0 || sample.time_ns > (std::int64_t{1} << 62))
            table.fail(row, "the time must be 0 to 2^62");
        if (row > 0 && sample.time_ns <= recording.samples.back().time_ns)
            table.fail(row, "its time is not after that of the row before");
        if (valid) {
            const std::int64_t flag = table.integer(row, *valid);
            if (flag != 0 && flag != 1)
                table.fail(row, "valid must be 0 or 1");
            sample.valid = flag == 1;
        }
        if (confidence)
            sample.confidence = table.number(row, *confidence);
        if (!(sample.confidence >= 0.0 && sample.confidence <= 1.0))
            table.fail(row, "the confidence must be 0 to 1");
        const bool stated = sample.valid;
        set_directions(sample, read_vector(table, row, both), read_vector(table, row, left),
                       read_vector(table, row, right));
        if (stated && valid && !sample.valid)
            table.fail(row, "it is valid but has no direction of any length");
        recording.samples.push_back(sample);
    }
    return recording;
}

GazeRecording read_gaze_csv(const std::filesystem::path& file) {
    return parse_gaze_csv(read_file(file, kMaxFileBytes), file.string());
}

std::string to_csv(const GazeRecording& recording) {
    std::string text = "time_ns,x,y,z,left_x,left_y,left_z,right_x,right_y,right_z,valid,"
                       "confidence\n";
    for (const GazeSample& s : recording.samples) {
        std::array<char, 32> confidence{};
        std::snprintf(confidence.data(), confidence.size(), "%.4g", s.confidence);
        text += std::to_string(s.time_ns) + ',' +
                vector_text(s.valid ? std::optional(s.direction) : std::nullopt) + ',' +
                vector_text(s.left) + ',' + vector_text(s.right) + ',' + (s.valid ? '1' : '0') +
                ',' + confidence.data() + '\n';
    }
    return text;
}

GazePointer recorded_gaze(GazeRecording recording, AtEnd at_end) {
    return std::make_unique<Recorded>(std::move(recording), at_end);
}

} // namespace macula::scene
