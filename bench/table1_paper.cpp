// Transcribed from Table 1 of Weier et al. 2016.
#include <array>

#include <fmt/format.h>

#include "bench/foveation_scenes.hpp"
#include "bench/table1.hpp"

namespace macula::bench {
namespace {

constexpr auto kPoint = frame::LightMode::point, kArea = frame::LightMode::area,
               kAo = frame::LightMode::ambient_occlusion;

constexpr std::string_view kUrban = "Urban Sprawl";

// clang-format off
constexpr std::array<PaperRow, 12> kPaper{{
    {"Sibenik", kPoint,  3.46, 0.81, 1.41,  10.74,  3.85, 0.64, 0.84, 0.00,  10.74,  6.74, 1.59},
    {"Sibenik", kArea,  15.57, 3.64, 1.51,  47.96, 14.80, 0.67, 0.85, 0.33,  47.96, 18.36, 2.61},
    {"Sibenik", kAo,    29.42, 6.88, 1.45,  94.64, 27.96, 0.64, 0.83, 0.32,  94.64, 31.39, 3.02},
    {"Sponza",  kPoint,  3.46, 0.64, 1.41,  13.93,  4.43, 0.58, 0.84, 0.00,  13.93,  7.26, 1.92},
    {"Sponza",  kArea,  15.54, 2.89, 1.44,  81.61, 20.07, 0.58, 0.83, 0.24,  81.61, 23.17, 3.52},
    {"Sponza",  kAo,    29.36, 5.45, 1.43, 179.01, 39.79, 0.58, 0.83, 0.24, 179.01, 42.87, 4.18},
    {"Rungholt", kPoint,  2.90, 0.58, 1.38,   9.51,  3.54, 0.59, 0.83, 0.00,   9.51,  6.34, 1.50},
    {"Rungholt", kArea,  11.10, 2.25, 1.38,  34.20,  9.98, 0.59, 0.83, 0.19,  34.20, 12.97, 2.64},
    {"Rungholt", kAo,    20.47, 4.17, 1.39, 168.03, 51.15, 0.59, 0.83, 0.19, 168.03, 54.14, 3.10},
    {kUrban, kPoint,  3.06, 0.64, 1.37,   8.97,  3.33, 0.60, 0.83, 0.00,   8.97,  6.12, 1.46},
    {kUrban, kArea,  12.34, 2.60, 1.36,  29.67,  8.68, 0.60, 0.83, 0.28,  29.67, 11.75, 2.52},
    {kUrban, kAo,    22.95, 4.85, 1.39, 110.11, 30.02, 0.60, 0.83, 0.29, 110.11, 33.13, 3.32},
}};
// clang-format on

struct StandIn {
    std::string_view ours, paper;
};
constexpr std::array kStandIns = {
    StandIn{"sibenik", "Sibenik"}, StandIn{"sponza_crytek", "Sponza"},
    StandIn{"atrium", "Sponza"},   StandIn{"voxel_city", "Rungholt"},
    StandIn{"city", kUrban},
};

} // namespace

std::span<const PaperRow> paper_rows() {
    return kPaper;
}

const PaperRow* paper_row(std::string_view scene, frame::LightMode lights) {
    for (const StandIn& stand_in : kStandIns) {
        if (stand_in.ours != scene)
            continue;
        for (const PaperRow& row : kPaper) {
            if (row.scene == stand_in.paper && row.lights == lights)
                return &row;
        }
    }
    return nullptr;
}

std::vector<std::string> table1_scenes(const std::vector<std::string>& scene_path) {
    std::vector<std::string> scenes;
    if (const std::string sibenik = scene_or("sibenik", "", scene_path); !sibenik.empty())
        scenes.push_back(sibenik);
    scenes.push_back(scene_or("sponza_crytek", "atrium", scene_path));
    scenes.insert(scenes.end(), {"voxel_city", "city"});
    return scenes;
}

Region table1_region() {
    return {"medium", 10.0f, 20.0f, 0.05f};
}

std::string paper_fields(const FoveationRow& row) {
    const PaperRow* paper = paper_row(row.scene, row.lights);
    if (paper == nullptr)
        return "\"paper_scene\":null,\"paper_speedup\":null,\"paper_efficiency\":null";
    return fmt::format(
        R"("paper_scene":"{}","paper_speedup":{},"paper_efficiency":{:.4f},"paper_rays_full":{},)"
        R"("paper_rays_ours":{},"paper_ms_full":{},"paper_ms_ours":{})",
        paper->scene, paper->speedup, paper->efficiency(), 1e6 * paper->mrays_full,
        1e6 * paper->mrays_ours, paper->ms_full, paper->ms_ours);
}

} // namespace macula::bench
