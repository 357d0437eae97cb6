#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "bench/flight.hpp"
#include "bench/quality_flight.hpp"
#include "bench/rrm_measure.hpp"
#include "host/metric/flip.hpp"
#include "scenes/gaze/spec.hpp"

namespace macula::bench {
namespace {

double mean_of(const metric::ScalarMap& map) {
    return std::accumulate(map.values.begin(), map.values.end(), 0.0) /
           static_cast<double>(map.values.size());
}

// The scores of one method, frame by frame.
struct Judged {
    render::Renderer renderer;
    metric::TemporalScores temporal;
    double flip = 0.0, foveated_flip = 0.0, samples = 0.0; // sums
};

// What a frame is compared with, and how.
struct Beside {
    metric::Picture full;
    metric::MotionField motion;
    metric::ScalarMap eccentricity, density;
    double pixels_per_degree;

    void add_to(Judged& one) const {
        const metric::Picture picture = copy_colour(one.renderer);
        one.flip += mean_of(metric::flip(full, picture, pixels_per_degree));
        one.foveated_flip += mean_of(metric::foveated_flip(full, picture, eccentricity, density));
        one.temporal.add(full, picture, eccentricity, &motion);
    }
};

RrmQuality quality_of(const Judged& one, std::uint32_t frames) {
    const metric::TemporalScore all = one.temporal.total().back();
    return {one.flip / frames, one.foveated_flip / frames, all.flicker_energy, all.instability,
            one.samples / frames};
}

} // namespace

std::vector<RrmQuality> measure_quality(const RrmScene& scene, const RrmOptions& options,
                                        std::span<const RrmMethod> methods, std::uint32_t depth,
                                        std::uint32_t first, const RrmNote& note) {
    const scene::Display& display = scene.display();
    const scene::GazeContext context{display, scene::Eye::mono, {}};
    const FlightView view(scene.scene(), display, scene::parse_gaze(options.gaze, context));
    render::Renderer full = scene.make({"full"}, depth, {"motion"});
    std::vector<Judged> all;
    for (const RrmMethod& method : methods)
        all.push_back({scene.make(method, depth), metric::TemporalScores{}});
    for (std::uint32_t frame = 0; frame < first + options.quality_frames; ++frame) {
        note(fmt::format("quality, frame {} of {}", frame + 1, first + options.quality_frames));
        const FlightFrame seen = view.at(frame);
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (methods[i].name != "rrm" && frame < first)
                continue; // has no history
            const auto report = all[i].renderer.render(frame, seen.camera, seen.gaze);
            all[i].samples += frame >= first ? camera_rays(report) : 0.0;
        }
        if (frame + 1 < first)
            continue;
        full.render(frame, seen.camera, seen.gaze); // motion is that from the frame before
        if (frame < first)
            continue;
        const Beside beside{copy_colour(full), copy_motion(full),
                            metric::eccentricity_map(display, scene::Eye::mono, seen.look),
                            metric::density_map(display, scene::Eye::mono),
                            scene::pixels_per_degree(display, scene::Eye::mono, 0.5 * display.width,
                                                     0.5 * display.height)};
        for (Judged& one : all)
            beside.add_to(one);
    }
    std::vector<RrmQuality> result;
    for (const Judged& one : all)
        result.push_back(quality_of(one, options.quality_frames));
    return result;
}

} // namespace macula::bench
