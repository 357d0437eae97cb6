#include "bench/foveation.hpp"

#include <span>

#include <fmt/format.h>

#include "bench/flight.hpp"
#include "bench/foveation_scenes.hpp"
#include "bench/resume_file.hpp"
#include "bench/series.hpp"
#include "host/metric/statistics.hpp"
#include "host/render/renderer.hpp"
#include "scenes/gaze/spec.hpp"

namespace macula::bench {
namespace {

void fill(FoveationRow& row, const Series& full, const Series& ours) {
    row.rays_full = mean(full.rays);
    row.rays_ours = mean(ours.rays);
    row.sampled = mean(ours.camera_rays) / mean(full.camera_rays);
    row.wall_ms_full = metric::median(full.wall_ms);
    row.wall_ms_ours = metric::median(ours.wall_ms);
    row.ms_full = metric::median(full.device_ms);
    row.ms_ours = metric::median(ours.device_ms);
    row.device_clock = row.ms_full > 0.0 && row.ms_ours > 0.0;
    if (!row.device_clock) {
        row.ms_full = row.wall_ms_full;
        row.ms_ours = row.wall_ms_ours;
    }
    for (std::size_t i = 0; i < kStageGroups; ++i)
        row.ms[i] = metric::median(ours.group_ms[i]);
    const std::vector<double> ratios = row.device_clock
                                           ? metric::ratios(full.device_ms, ours.device_ms)
                                           : metric::ratios(full.wall_ms, ours.wall_ms);
    row.speedup = metric::median(ratios);
    row.wall_speedup = metric::median(metric::ratios(full.wall_ms, ours.wall_ms));
    row.speedup_p10 = metric::percentile(ratios, 0.1);
    row.speedup_p90 = metric::percentile(ratios, 0.9);
    row.efficiency = row.speedup * row.rays_ours / row.rays_full;
}

// A scene with the display and gaze of the benchmark.
class Flight {
  public:
    Flight(const FoveationOptions& options, compute::Device& device, const std::string& name)
        : options_(options), device_(device), name_(scene_name(name)),
          scene_(load_fly_through(name, options.scene_path)),
          display_(sized_display(options.display, options.width, options.height)),
          gaze_name_(gaze_of(options, display_)->describe()),
          view_(scene_, display_, gaze_of(options, display_)) {}

    // What a row of these lights and region will say besides its figures.
    FoveationRow blank_row(frame::LightMode lights, const Region& region) const {
        FoveationRow row;
        row.scene = name_;
        row.frc = region.name;
        row.lights = lights;
        row.width = display_.width;
        row.height = display_.height;
        row.frames = options_.frames;
        row.segments = options_.segments;
        row.warm_up = options_.warm_up;
        row.gaze = gaze_name_;
        row.device = device_.facts().name;
        row.driver = device_.facts().driver_version;
        row.commit = MACULA_COMMIT;
        return row;
    }

    // Fills the rows, which share their lights: one for each region.
    void measure(std::vector<FoveationRow>& rows, std::span<const Region> regions) {
        const frame::LightMode lights = rows.front().lights;
        std::vector<render::Renderer> methods;
        methods.push_back(make("full", lights, Region{}));
        for (const Region& region : regions)
            methods.push_back(make("weier", lights, region));
        std::vector<Series> series(methods.size());
        const Schedule schedule(options_.frames, options_.segments, options_.warm_up,
                                scene_.path.frames);
        render(methods.front(), schedule.first(0)); // its first frame builds its kernels
        for (std::uint32_t segment = 0; segment < options_.segments; ++segment)
            fly(methods, series, schedule.first(segment), schedule.count(segment));
        for (std::size_t i = 0; i < rows.size(); ++i) {
            rows[i].triangles = methods.front().geometry().triangles;
            fill(rows[i], series.front(), series[i + 1]);
        }
    }

  private:
    static scene::GazePointer gaze_of(const FoveationOptions& options,
                                      const scene::Display& display) {
        return scene::parse_gaze(options.gaze, {display, scene::Eye::mono, {}});
    }

    render::Renderer make(const char* method, frame::LightMode lights, const Region& region) const {
        render::Options engine;
        engine.method = method;
        engine.width = display_.width;
        engine.height = display_.height;
        engine.lights = lights;
        engine.light_samples = options_.light_samples;
        engine.ambient_occlusion_samples = options_.ambient_occlusion_samples;
        engine.tangents = tangents_of(display_);
        engine.weier.r0 = region.r0;
        engine.weier.r1 = region.r1;
        engine.weier.p_min = region.p_min;
        engine.geometry.cache_directory = options_.bvh_cache;
        return {device_, scene_, engine};
    }

    render::FrameReport render(render::Renderer& renderer, std::uint32_t frame) {
        const FlightFrame view = view_.at(frame);
        return renderer.render(frame, view.camera, view.gaze);
    }

    // `full` has no history to warm up.
    void fly(std::vector<render::Renderer>& methods, std::vector<Series>& series,
             std::uint32_t first, std::uint32_t count) {
        for (std::size_t i = 1; i < methods.size(); ++i) {
            methods[i].reset();
            for (std::uint32_t frame = first - options_.warm_up; frame < first; ++frame)
                render(methods[i], frame);
        }
        for (std::uint32_t frame = first; frame < first + count; ++frame) {
            for (std::size_t turn = 0; turn < methods.size(); ++turn) {
                // Forwards and backwards, so that no method always follows the same one.
                const std::size_t i = frame % 2 == 0 ? turn : methods.size() - 1 - turn;
                series[i].add(render(methods[i], frame));
            }
        }
    }

    const FoveationOptions& options_;
    compute::Device& device_;
    std::string name_;
    scene::Scene scene_;
    scene::Display display_;
    std::string gaze_name_;
    FlightView view_;
};

} // namespace

std::vector<FoveationRow> run_foveation(const FoveationOptions& options,
                                        const std::vector<Region>& regions,
                                        const FoveationProgress& progress) {
    Schedule(options.frames, options.segments, options.warm_up, 0); // refuses before it loads
    compute::Device device = compute::open(options.device);
    const ResumeFile file(options.resume);
    std::vector<frame::LightMode> lights = options.lights;
    if (lights.empty())
        lights = {frame::LightMode::point, frame::LightMode::area,
                  frame::LightMode::ambient_occlusion};
    std::vector<FoveationRow> all;
    for (const std::string& name : options.scenes) {
        progress.note("loading " + name);
        Flight flight(options, device, name);
        for (const frame::LightMode mode : lights) {
            std::vector<FoveationRow> rows;
            std::vector<Region> missing;
            for (const Region& region : regions) {
                const FoveationRow blank = flight.blank_row(mode, region);
                if (const FoveationRow* known = file.find(blank)) {
                    all.push_back(*known);
                    progress.row(*known, false);
                } else {
                    rows.push_back(blank);
                    missing.push_back(region);
                }
            }
            if (rows.empty())
                continue;
            progress.note(fmt::format("{}, {}", name, frame::name(mode)));
            flight.measure(rows, missing);
            for (const FoveationRow& row : rows) {
                file.add(json_line(row, progress.more(row)));
                all.push_back(row);
                progress.row(row, true);
            }
        }
    }
    return all;
}

} // namespace macula::bench
