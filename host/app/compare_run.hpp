/// Comparing a sequence (or one picture) with its reference, frame by frame.
#pragma once

#include "host/app/compare_files.hpp"
#include "host/app/compare_options.hpp"
#include "host/metric/temporal.hpp"

namespace macula::app {

struct ComparedFrame {
    std::uint32_t frame = 0;
    metric::FrameScores scores; // without maps
    std::vector<metric::TemporalScore> temporal;
};

struct Compared {
    std::string reference, test;
    std::string display; // empty: none was named
    double pixels_per_degree = 0.0;
    std::string pixels_per_degree_source;
    std::uint32_t width = 0, height = 0;
    std::vector<ComparedFrame> frames;
    metric::FrameScores mean;
    std::vector<metric::TemporalScore> temporal; // empty: no_temporal says why
    std::string no_temporal;
    std::vector<std::string> heat_maps; // files that were written
};

/// `motion`: of --motion, or null. `test_number`: from 1, in the names of heat maps.
/// Throws std::runtime_error and std::invalid_argument that name files and options.
Compared compare_frames(const CompareOptions& options, const FrameList& reference,
                        const FrameList& test, const FrameList* motion, unsigned test_number);

} // namespace macula::app
