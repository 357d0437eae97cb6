// One function for each foreign format. All throw SceneError with file and line.
#pragma once

#include <array>
#include <optional>

#include "scenes/gaze/csv.hpp"
#include "scenes/gaze/import.hpp"

namespace macula::scene {

// Appends samples whose times go on, counts the others, and makes times start at 0.
class TraceBuilder {
  public:
    TraceBuilder(const CsvTable& table, std::string format);

    void add(std::size_t row, GazeSample sample); // its time_ns in the file's own clock
    void add(std::size_t row, HeadSample sample);
    // Numbers its notes; throws when nothing was added.
    ImportedTrace take();

  private:
    template <typename Sample>
    void append(std::size_t row, Sample sample, std::vector<Sample>& samples);

    const CsvTable& table_;
    ImportedTrace trace_;
    std::int64_t start_ = 0;
    bool started_ = false;
    std::size_t repeated_ = 0;
};

// A vector of three columns with signs, in head space; nothing where a cell is empty or nan.
struct VectorColumns {
    std::size_t column[3] = {};
    double sign[3] = {1.0, 1.0, 1.0};
    std::optional<glm::dvec3> read(const CsvTable& table, std::size_t row) const;
};
// Columns prefix + {"x", "y", "z"}.
VectorColumns vector_columns(const CsvTable& table, const std::string& prefix,
                             const std::array<double, 3>& sign, bool upper_case = false);

std::int64_t nanoseconds(const CsvTable& table, std::size_t row, std::size_t column,
                         double per_unit);

ImportedTrace import_vive_pro_eye(const CsvTable& table);
ImportedTrace import_pico_neo3(const CsvTable& table);
ImportedTrace import_head_quaternions(const CsvTable& table);
ImportedTrace import_pupil_core(const CsvTable& table);
ImportedTrace import_pupil_neon(const CsvTable& table);
ImportedTrace import_tobii_pro_lab(const CsvTable& table);
ImportedTrace import_tobii_sdk(const CsvTable& table);

} // namespace macula::scene
