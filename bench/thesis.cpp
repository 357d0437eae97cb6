#include "bench/thesis.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>

#include "bench/foveation_scenes.hpp"
#include "bench/line_file.hpp"
#include "bench/quality_flight.hpp"
#include "host/metric/flip.hpp"
#include "host/metric/pool.hpp"
#include "host/metric/statistics.hpp"
#include "host/metric/temporal.hpp"
#include "host/render/renderer.hpp"

namespace macula::bench {
namespace {

constexpr float kDegreesAFrame = 0.25f; // of the orbit
// Frames of the orbit before it is judged: what has a history needs some.
constexpr std::uint32_t kOrbitWarmUp = 12;

// The radii of the sweep, half diagonals.
constexpr std::array kSweep = {0.0f,  0.05f, 0.075f, 0.1f, 0.125f, 0.15f, 0.175f, 0.2f,
                               0.25f, 0.3f,  0.4f,   0.5f, 0.6f,   0.8f,  1.0f};

auto key(const ThesisRow& r) {
    return std::tie(r.scene, r.view, r.mode, r.ours, r.lights, r.width, r.height, r.frames,
                    r.warm_up, r.device, r.disk);
}

void check(const ThesisOptions& o) {
    if (o.frames < 1 || o.frames > 100000)
        throw std::invalid_argument("--frames must lie between 1 and 100000");
    if (o.warm_up > 100000 || o.orbit > 100000)
        throw std::invalid_argument("--warm-up and --orbit must be at most 100000");
    if (o.orbit == 1)
        throw std::invalid_argument("--orbit: one frame does not move; 0 leaves the motion out");
    if (o.reference_spp < 1 || o.orbit_spp < 1)
        throw std::invalid_argument("--reference-spp and --orbit-spp must be at least 1");
}

// A view of a scene on the device.
struct Place {
    scene::Scene scene;
    std::string name; // of what stands for the thesis's scene
    std::shared_ptr<render::DeviceScene> on_device;
};

scene::Camera camera_of(const scene::Scene& scene, std::string_view name) {
    const auto at = std::find_if(scene.cameras.begin(), scene.cameras.end(),
                                 [&](const scene::Camera& c) { return c.name == name; });
    return at != scene.cameras.end() ? *at : scene.cameras.at(0);
}

// Around the target, about the camera's up axis.
scene::Camera turned(const scene::Camera& camera, float degrees) {
    const float angle = degrees * std::numbers::pi_v<float> / 180.0f;
    const glm::vec3 axis = glm::normalize(camera.up), arm = camera.eye - camera.target;
    scene::Camera result = camera;
    result.eye = camera.target + arm * std::cos(angle) + glm::cross(axis, arm) * std::sin(angle) +
                 axis * (glm::dot(axis, arm) * (1.0f - std::cos(angle)));
    return result;
}

// Distances from the image's centre in half diagonals, and the part outside of the disk.
metric::ScalarMap distances(std::uint32_t width, std::uint32_t height) {
    metric::ScalarMap map(width, height);
    const double far = 0.5 * std::hypot(width, height);
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x)
            map.values[std::size_t{y} * width + x] =
                static_cast<float>(std::hypot(x + 0.5 - 0.5 * width, y + 0.5 - 0.5 * height) / far);
    }
    return map;
}

struct Times {
    std::vector<double> ms, wall_ms;
    std::array<std::vector<double>, kThesisStages> stage_ms;
    double samples = 0.0, rays = 0.0;

    void add(const render::FrameReport& report) {
        std::array<double, kThesisStages> sums{};
        for (const frame::StageTime& stage : report.stages)
            sums[static_cast<std::size_t>(thesis_stage(stage.stage))] += stage.device_ms;
        double all = 0.0;
        for (std::size_t i = 0; i < kThesisStages; ++i) {
            stage_ms[i].push_back(sums[i]);
            all += sums[i];
        }
        ms.push_back(all);
        wall_ms.push_back(report.wall_ms);
        samples += camera_rays(report);
        rays += static_cast<double>(report.total_rays());
    }
    void fill(ThesisRow& row) const {
        row.ms = metric::median(ms);
        if (row.ms <= 0.0)
            row.ms = metric::median(wall_ms);
        for (std::size_t i = 0; i < kThesisStages; ++i)
            row.stage_ms[i] = metric::median(stage_ms[i]);
        row.samples = samples / static_cast<double>(ms.size());
        row.rays = rays / static_cast<double>(ms.size());
    }
};

class View {
  public:
    View(const ThesisOptions& options, const ThesisView& view, const Place& place,
         const compute::Device& device)
        : options_(options), view_(view), place_(place), device_(device),
          camera_(camera_of(place.scene, view.view)), outside_(distances(o().width, o().height)) {}

    ThesisRow blank(std::string_view mode) const {
        ThesisRow row;
        row.scene = view_.scene;
        row.view = view_.view;
        row.mode = mode;
        row.ours = place_.name;
        row.lights = lights();
        row.width = o().width;
        row.height = o().height;
        row.frames = o().frames;
        row.warm_up = o().warm_up;
        row.device = device_.facts().name;
        row.driver = device_.facts().driver_version;
        row.commit = MACULA_COMMIT;
        return row;
    }

    // The rows' modes side by side: they take their frames in turn.
    void measure(std::vector<ThesisRow>& rows, std::span<const ThesisMode> modes,
                 const ThesisProgress& progress) const {
        std::vector<render::Renderer> renderers;
        for (const ThesisMode& mode : modes)
            renderers.push_back(make(mode.method, view_.depth, 1));
        std::vector<Times> times(modes.size());
        std::vector<metric::TemporalScores> still;
        for (std::size_t i = 0; i < modes.size(); ++i)
            still.emplace_back(bands());
        progress.note(view_.name() + ": reference");
        render::Renderer converged = make("full", view_.reference_depth, o().reference_spp);
        converged.render(0, camera_);
        const metric::Picture reference = copy_colour(converged);
        for (std::uint32_t frame = 0; frame < o().warm_up + o().frames; ++frame) {
            progress.note(fmt::format("{}: frame {}", view_.name(), frame));
            for (std::size_t turn = 0; turn < renderers.size(); ++turn) {
                const std::size_t i = frame % 2 == 0 ? turn : renderers.size() - 1 - turn;
                const render::FrameReport report = renderers[i].render(frame, camera_);
                if (frame < o().warm_up)
                    continue;
                times[i].add(report);
                if (frame + kStillFrames >= o().warm_up + o().frames)
                    still[i].add(reference, copy_colour(renderers[i]), outside_);
            }
        }
        for (std::size_t i = 0; i < rows.size(); ++i) {
            times[i].fill(rows[i]);
            rows[i].flicker_still = still[i].total().front().flicker_energy;
            const metric::Pooled flip =
                metric::pool(metric::flip(reference, copy_colour(renderers[i])).values);
            rows[i].flip_weighted_median = flip.weighted_median;
            rows[i].flip_mean = flip.mean;
        }
        if (o().orbit > 0)
            orbit(rows, renderers, progress);
    }

    // Figure 5.2: the foveated mode with other disks.
    void sweep(std::vector<ThesisRow>& rows) const {
        std::vector<render::Renderer> renderers;
        for (const ThesisRow& row : rows)
            renderers.push_back(make("logpolar", view_.depth, 1, static_cast<float>(*row.disk)));
        std::vector<Times> times(rows.size());
        for (std::uint32_t frame = 0; frame < o().frames + 1; ++frame) {
            for (std::size_t turn = 0; turn < rows.size(); ++turn) {
                const std::size_t i = frame % 2 == 0 ? turn : rows.size() - 1 - turn;
                const render::FrameReport report = renderers[i].render(frame, camera_);
                if (frame > 0)
                    times[i].add(report);
            }
        }
        for (std::size_t i = 0; i < rows.size(); ++i)
            times[i].fill(rows[i]);
    }

    frame::LightMode lights() const { return o().lights.value_or(frame::LightMode::soft); }

  private:
    static constexpr std::uint32_t kStillFrames = 6; // the last ones, judged for flicker

    const ThesisOptions& o() const { return options_; }

    static std::vector<metric::Band> bands() {
        return {{"outside of the disk", stage::LogPolarOptions{}.disk, 2.0}};
    }

    render::Renderer make(std::string_view method, std::uint32_t depth, std::uint32_t spp,
                          std::optional<float> disk = {}) const {
        render::Options engine;
        engine.width = o().width;
        engine.height = o().height;
        engine.method = method;
        engine.lights = lights();
        engine.light_samples = o().light_samples;
        engine.samples_per_pixel = spp;
        engine.depth = depth;
        engine.seed = o().seed;
        // The thesis's buffer is as large as the image that is rendered (section 3.1.1): of
        // upscaled modes that is the default.
        if (method == "logpolar")
            engine.log_polar.sigma = 1.0f;
        engine.log_polar.disk = disk.value_or(engine.log_polar.disk);
        return {place_.on_device, place_.scene, engine};
    }

    // The camera goes around what it looks at, as in the thesis's videos (section 5.3).
    void orbit(std::vector<ThesisRow>& rows, std::vector<render::Renderer>& renderers,
               const ThesisProgress& progress) const {
        render::Renderer converged = make("full", view_.depth, o().orbit_spp);
        render::Options with_motion = converged.options();
        with_motion.samples_per_pixel = 1;
        with_motion.images = {"motion"};
        render::Renderer full(place_.on_device, place_.scene, with_motion);
        std::vector<metric::TemporalScores> scores;
        for (render::Renderer& renderer : renderers) {
            renderer.reset();
            scores.emplace_back(bands());
        }
        for (std::uint32_t frame = 0; frame < kOrbitWarmUp + o().orbit; ++frame) {
            progress.note(fmt::format("{}: orbit, frame {}", view_.name(), frame));
            const scene::Camera view = turned(camera_, kDegreesAFrame * static_cast<float>(frame));
            for (render::Renderer& renderer : renderers)
                renderer.render(frame, view);
            if (frame + 1 < kOrbitWarmUp)
                continue;
            full.render(frame, view);
            if (frame < kOrbitWarmUp)
                continue;
            converged.render(frame, view);
            const metric::Picture reference = copy_colour(converged);
            const metric::MotionField motion = copy_motion(full);
            for (std::size_t i = 0; i < renderers.size(); ++i)
                scores[i].add(reference, copy_colour(renderers[i]), outside_, &motion);
        }
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const metric::TemporalScore all = scores[i].total().front();
            rows[i].flicker = all.flicker_energy;
            rows[i].instability = all.instability;
        }
    }

    const ThesisOptions& options_;
    const ThesisView& view_;
    const Place& place_;
    const compute::Device& device_;
    scene::Camera camera_;
    metric::ScalarMap outside_;
};

// Scenes are loaded once for all of their views.
class Places {
  public:
    Places(const ThesisOptions& options, const compute::Device& device)
        : options_(options), device_(device) {}

    const Place& of(const ThesisView& view) {
        const std::string file(view.file);
        if (const auto known = places_.find(file); known != places_.end())
            return known->second;
        places_.clear(); // one at a time is in memory
        Place place;
        place.name =
            view.stand_in.empty() || !scene_or("sponza_crytek", "", options_.scene_path).empty()
                ? file
                : std::string(view.stand_in);
        place.scene = load_fly_through(place.name, options_.scene_path);
        frame::GeometryOptions geometry;
        geometry.cache_directory = options_.bvh_cache;
        place.on_device = std::make_shared<render::DeviceScene>(device_, place.scene, geometry);
        return places_.emplace(file, std::move(place)).first->second;
    }

  private:
    const ThesisOptions& options_;
    const compute::Device& device_;
    std::map<std::string, Place> places_;
};

class Run {
  public:
    Run(const ThesisOptions& options, const ThesisProgress& progress)
        : options_(options), progress_(progress), device_(compute::open(options.device)),
          file_(options.resume,
                [this](const std::string& line) { known_.push_back(parse_thesis_row(line)); }) {}

    std::vector<ThesisRow> operator()() {
        Places places(options_, device_);
        const auto modes = find_thesis_modes(options_.modes);
        for (const ThesisView& wanted : find_thesis_views(options_.views)) {
            progress_.note("loading " + std::string(wanted.file));
            const View view(options_, wanted, places.of(wanted), device_);
            std::vector<ThesisRow> rows;
            std::vector<ThesisMode> missing;
            for (const ThesisMode& mode : modes) {
                if (take(view.blank(mode.name)))
                    continue;
                rows.push_back(view.blank(mode.name));
                missing.push_back(mode);
            }
            if (!rows.empty()) {
                view.measure(rows, missing, progress_);
                keep(rows);
            }
            if (options_.sweep && wanted.view == "overview") // section 5.2's
                sweep(view);
        }
        return all_;
    }

  private:
    bool take(const ThesisRow& wanted) {
        // A row without motion is no answer where it is asked for; the sweep never has it.
        const bool moves = options_.orbit > 0 && !wanted.disk;
        const auto at = std::find_if(known_.begin(), known_.end(), [&](const ThesisRow& row) {
            return key(row) == key(wanted) && (row.flicker || !moves);
        });
        if (at == known_.end())
            return false;
        all_.push_back(*at);
        progress_.row(*at, false);
        return true;
    }

    void keep(const std::vector<ThesisRow>& rows) {
        for (const ThesisRow& row : rows) {
            file_.add(json_line(row));
            all_.push_back(row);
            progress_.row(row, true);
        }
    }

    void sweep(const View& view) {
        std::vector<ThesisRow> rows;
        for (const float disk : kSweep) {
            ThesisRow row = view.blank("logpolar");
            row.disk = disk;
            row.predicted =
                predicted_samples(row.width, row.height, disk, stage::LogPolarOptions{}.alpha, 1.0);
            if (!take(row))
                rows.push_back(row);
        }
        if (rows.empty())
            return;
        view.sweep(rows);
        keep(rows);
    }

    const ThesisOptions& options_;
    const ThesisProgress& progress_;
    compute::Device device_;
    std::vector<ThesisRow> known_; // filled while file_ is made
    LineFile file_;
    std::vector<ThesisRow> all_;
};

} // namespace

double predicted_samples(std::uint32_t width, std::uint32_t height, double disk, double alpha,
                         double sigma) {
    const double far = 0.5 * std::hypot(width, height), radius = disk * far;
    // Equation 4.5, in which the logarithm of a radius below a pixel has no column.
    const double part = radius > 1.0 ? std::min(std::log(radius) / std::log(far), 1.0) : 0.0;
    const double columns = std::round(width / sigma), rows = std::round(height / sigma);
    const double column = std::min(std::ceil(std::pow(part, 1.0 / alpha) * columns), columns);
    double inside = 0.0; // equation 5.2, pixel by pixel
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x)
            inside += std::hypot(x + 0.5 - 0.5 * width, y + 0.5 - 0.5 * height) < radius ? 1 : 0;
    }
    return (columns - column) * rows + inside;
}

std::vector<ThesisRow> run_thesis(const ThesisOptions& options, const ThesisProgress& progress) {
    check(options);
    return Run(options, progress)();
}

} // namespace macula::bench
