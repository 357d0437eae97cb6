// `macula bench table1`: Table 1 of Weier et al. 2016 ("Foveated Real-Time Ray Tracing for
// Head-Mounted Displays") with our figures beside the paper's.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/foveation.hpp"

namespace macula::bench {

// A row as printed: GeForce Titan X, 1182 x 1464, one eye, medium region, gaze at the centre.
struct PaperRow {
    std::string_view scene; // the paper's
    frame::LightMode lights;
    double mrays_full, mrays_ours;
    double reproject, ray_tracing_full, ray_tracing_ours, cache_update, merge, post; // ms
    double ms_full, ms_ours, speedup;

    double efficiency() const { return speedup * mrays_ours / mrays_full; }
    double overhead() const { return (reproject + cache_update + merge + post) / ms_full; }
};
std::span<const PaperRow> paper_rows();
// The paper's row for a scene of ours or its stand-in; null for any other scene.
const PaperRow* paper_row(std::string_view scene, frame::LightMode lights);

// sibenik and sponza_crytek where they are found, else atrium; voxel_city; city.
std::vector<std::string> table1_scenes(const std::vector<std::string>& scene_path);
// The medium region.
Region table1_region();

// The paper's fields of a row's JSON line, for json_line().
std::string paper_fields(const FoveationRow& row);

std::string table1_heading();
// Ours, and below it the paper's where there is one.
std::string table1_lines(const FoveationRow& row);
// Means, and the targets with what became of them.
std::string table1_summary(std::span<const FoveationRow> rows);

} // namespace macula::bench
