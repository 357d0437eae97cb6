#include <fmt/format.h>

#include "bench/rrm_measure.hpp"
#include "bench/series.hpp"
#include "host/metric/statistics.hpp"

namespace macula::bench {
namespace {

// A renderer and what it needed: an entry for each gaze.
struct Contestant {
    render::Renderer renderer;
    std::uint32_t next = 0; // frame
    Series medians = {};

    // The median of the measured frames becomes one entry.
    void look(const scene::Camera& camera, const frame::Gaze& gaze, std::uint32_t warm_up,
              std::uint32_t measured) {
        Series here;
        for (std::uint32_t i = 0; i < warm_up + measured; ++i) {
            const render::FrameReport report = renderer.render(next++, camera, gaze);
            if (i >= warm_up)
                here.add(report);
        }
        medians.device_ms.push_back(metric::median(here.device_ms));
        medians.wall_ms.push_back(metric::median(here.wall_ms));
        medians.rays.push_back(mean(here.rays));
        medians.camera_rays.push_back(mean(here.camera_rays));
        for (std::size_t g = 0; g < kStageGroups; ++g)
            medians.group_ms[g].push_back(metric::median(here.group_ms[g]));
    }
};

double mean_rate(const std::vector<double>& milliseconds) {
    std::vector<double> rates;
    for (const double ms : milliseconds)
        rates.push_back(1000.0 / ms);
    return mean(rates);
}

RrmSpeed compare(const Series& full, const Series& ours) {
    RrmSpeed speed;
    speed.wall_ms_full = metric::median(full.wall_ms);
    speed.wall_ms_ours = mean(ours.wall_ms);
    speed.ms_full = metric::median(full.device_ms);
    speed.ms_ours = mean(ours.device_ms);
    speed.device_clock = speed.ms_full > 0.0 && speed.ms_ours > 0.0;
    if (!speed.device_clock) {
        speed.ms_full = speed.wall_ms_full;
        speed.ms_ours = speed.wall_ms_ours;
    }
    speed.mean_rate = mean_rate(speed.device_clock ? ours.device_ms : ours.wall_ms);
    for (std::size_t g = 0; g < kStageGroups; ++g)
        speed.ms[g] = mean(ours.group_ms[g]);
    speed.samples_full = mean(full.camera_rays);
    speed.samples_ours = mean(ours.camera_rays);
    speed.rays_full = mean(full.rays);
    speed.rays_ours = mean(ours.rays);
    return speed;
}

} // namespace

std::vector<RrmSpeed> measure_speed(const RrmScene& scene, const RrmOptions& options,
                                    std::span<const RrmMethod> methods, std::uint32_t depth,
                                    const RrmNote& note) {
    std::vector<Contestant> all;
    all.push_back({scene.make({"full"}, depth)});
    for (const RrmMethod& method : methods)
        all.push_back({scene.make(method, depth)});
    const scene::Camera camera = scene.camera();
    const std::vector<frame::Gaze> gazes = scene.gazes();
    for (Contestant& one : all) // builds kernels, and has no history
        one.renderer.render(one.next++, camera, gazes.front());
    for (std::size_t i = 0; i < gazes.size(); ++i) {
        note(fmt::format("foveal position {} of {}", i + 1, gazes.size()));
        for (std::size_t turn = 0; turn < all.size(); ++turn) {
            const std::size_t m = i % 2 == 0 ? turn : all.size() - 1 - turn;
            if (m == 0) // has nothing to warm up, and is the same at all positions
                all[m].look(camera, gazes[i], 0, 1);
            else
                all[m].look(camera, gazes[i], options.warm_up, options.frames);
        }
    }
    std::vector<RrmSpeed> speeds;
    for (std::size_t m = 1; m < all.size(); ++m)
        speeds.push_back(compare(all.front().medians, all[m].medians));
    return speeds;
}

} // namespace macula::bench
