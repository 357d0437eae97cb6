// What `macula bench quality` finds for one case, as one line of JSON: the schema is
// docs/quality.md. Written by bench/, read by the report.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace macula::report {

inline constexpr int kSchema = 1;

// Milliseconds over the measured frames.
struct Percentiles {
    double median = 0.0, p95 = 0.0, p99 = 0.0;
};

struct StageRow {
    std::string stage;
    std::uint32_t launches = 0; // a frame
    Percentiles ms;
};

// Of the FLIP errors (0..1) of all measured pixels.
struct Errors {
    double mean = 0.0, weighted_median = 0.0, q1 = 0.0, q3 = 0.0, max = 0.0;
};

struct Scores {
    Errors flip, foveated_flip;
    std::optional<double> psnr; // dB; none: identical
    double ssim = 0.0;
    // Of host/metric/temporal.hpp, over the pairs of neighbouring frames; none without such a pair.
    std::optional<double> flicker_energy, instability;
};

// Against the frames of `full` with one sample a pixel, whose aliasing the reference has not.
struct AgainstFull {
    double flip = 0.0;
    double r0 = 0.0;                      // degrees
    std::optional<double> flip_inside_r0; // mean where the eccentricity is less; none: no pixel
};

// A band of eccentricities, degrees.
struct Band {
    std::string name;
    double from = 0.0, to = 0.0;
    double part = 0.0; // of the pixels
    std::optional<double> flip, flicker_energy, instability;
};

// Mean FLIP at eccentricities (degrees, the middles of equal steps).
struct Curve {
    std::vector<double> degrees, flip;
};

// Frame by frame, all of one length.
struct Series {
    std::vector<std::uint32_t> frame;
    std::vector<double> ms, flip, foveated_flip;
    // None in a stretch's first frame.
    std::vector<std::optional<double>> flicker_energy, instability;
};

// Files below the folder of the results.
struct Picture {
    std::uint32_t frame = 0;
    std::optional<std::array<double, 2>> gaze; // pixels from the upper left corner
    std::string reference, test, heat_map;
};

struct View {
    double tan_left = 1.0, tan_right = 1.0, tan_up = 1.0, tan_down = 1.0;
};

// What a method was given; none where it has no such parameter.
struct Parameters {
    std::optional<std::uint32_t> spp;
    std::optional<std::string> frc;
    std::optional<double> r0, r1, p_min; // degrees, degrees, part; r0 and r1 none: infinite
    std::optional<std::string> changes;  // of weier: "eps-lum=0.2,k-min=0.05"
    std::optional<double> scale;         // of lowres, along each axis
    // lowres: "samples" or "time", and the case that has as many or takes as long.
    std::optional<std::string> equal, equal_to;
    // Of equal time: its ms by the other's, median over frames that were rendered in turn.
    std::optional<double> time_ratio;
};

struct QualityCase {
    std::string scene, lights, method;
    std::string name; // of method and parameters, for people; "case" in JSON
    Parameters parameters;
    std::uint32_t width = 0, height = 0, frames = 0, segments = 0, warm_up = 0;
    std::uint32_t reference_spp = 0, seed = 0;
    std::uint32_t light_samples = 0, ambient_occlusion_samples = 0;
    std::string display, gaze, head;
    View view;
    double pixels_per_degree = 0.0; // that FLIP was given
    std::string device, driver, commit;
    std::string clock; // of the times: "device" or "wall"
    Percentiles time_ms, wall_ms;
    std::vector<StageRow> stages;
    double samples = 0.0, rays = 0.0; // a frame: of the camera, of all kinds
    Scores scores;                    // against the converged reference
    AgainstFull against_full;
    std::vector<Band> bands;
    Curve eccentricity;
    Series series;
    std::vector<Picture> pictures;
};

// One line without a line end.
std::string json_line(const QualityCase& result);
// Throws std::invalid_argument that names the field and what is wrong with it.
QualityCase parse_case(const std::string& line);

// All that a case was asked for and nothing that it found: equal cases need not run twice.
std::string identity(const QualityCase& result);

} // namespace macula::report
