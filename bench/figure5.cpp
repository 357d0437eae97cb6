#include "bench/figure5.hpp"

#include <limits>

#include <fmt/format.h>

#include "bench/foveation_scenes.hpp"

namespace macula::bench {

std::vector<Region> figure5_regions() {
    constexpr float kAll = std::numeric_limits<float>::infinity();
    return {{"small", 5.0f, 10.0f, 0.01f},
            {"medium", 10.0f, 20.0f, 0.05f},
            {"large", 15.0f, 30.0f, 0.1f},
            {"full", kAll, kAll, 1.0f}};
}

std::vector<std::string> figure5_scenes(const std::vector<std::string>& scene_path) {
    return {scene_or("sponza_crytek", "atrium", scene_path)};
}

std::string figure5_heading() {
    return fmt::format("{:<14} {:<6} {:<7} {:>8} {:>8} {:>9} {:>9} {:>9} {:>9} {:>8}\n", "scene",
                       "lights", "region", "pixels", "Mrays", "ms", "FPS", "full, ms", "speed-up",
                       "effic.");
}

std::string figure5_line(const FoveationRow& row) {
    return fmt::format(
        "{:<14} {:<6} {:<7} {:>6.1f} % {:>8.2f} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.2f} {:>8.3f}\n",
        row.scene, frame::name(row.lights), row.frc, 100.0 * row.sampled, 1e-6 * row.rays_ours,
        row.ms_ours, 1e3 / row.ms_ours, row.ms_full, row.speedup, row.efficiency);
}

} // namespace macula::bench
