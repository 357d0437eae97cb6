#include "bench/rrm.hpp"

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>

#include "bench/foveation_scenes.hpp"
#include "bench/line_file.hpp"
#include "bench/rrm_measure.hpp"
#include "scenes/load.hpp"

namespace macula::bench {
namespace {

constexpr std::array kCases = {
    RrmCase{"whitted", "whitted", false, 3.2, 5.5, 82.0, 260.0},
    RrmCase{"whitted secondary", "whitted", true, 6.3, 6.3, 19.0, 119.0},
    RrmCase{"bunny", "bunny_5k", false, 2.8, 5.5, 49.0, 138.0},
};
constexpr std::string_view kPhysics = "physics";
// The paper's, one with a finer mesh, and one that is always there.
constexpr std::array kPhysicsScenes = {"bunny_5k_spheres", "bunny_spheres", "spheres"};
// Figure 9's range.
constexpr std::array kSweep = {12u, 24u, 48u, 72u, 96u, 120u, 132u};
// Figure 10's ends.
constexpr std::array kQuality = {12u, 132u};

auto key(const RrmRow& r) {
    return std::tie(r.name, r.method, r.scene, r.n, r.depth, r.display, r.width, r.height,
                    r.columns, r.rows, r.frames, r.warm_up, r.fovea, r.seed, r.gaze, r.ring_edges,
                    r.device);
}

void require(bool holds, const char* what) {
    if (!holds)
        throw std::invalid_argument(what);
}

void check(const RrmOptions& o) {
    const auto in = [](std::uint32_t value, std::uint32_t least, std::uint32_t most) {
        return value >= least && value <= most;
    };
    require(in(o.columns, 1, 1000) && in(o.rows, 1, 1000),
            "--positions must be COLUMNSxROWS, each 1 to 1000");
    require(in(o.frames, 1, 1000), "--frames must lie between 1 and 1000");
    require(in(o.warm_up, 0, 1000), "--warm-up must lie between 0 and 1000");
    require(in(o.n, 1, 132), "--n must lie between 1 and 132");
    require(in(o.quality_frames, 2, 1000), "--quality-frames must lie between 2 and 1000");
    require(in(o.physics_frames, 1, 100000), "--physics-frames must lie between 1 and 100000");
    for (const std::string& name : o.cases) {
        const bool known =
            name == kPhysics || std::any_of(kCases.begin(), kCases.end(),
                                            [&](const RrmCase& one) { return one.name == name; });
        if (!known)
            throw std::invalid_argument(fmt::format(
                "--cases \"{}\": whitted, whitted secondary, bunny or physics was expected", name));
    }
}

class Run {
  public:
    Run(const RrmOptions& options, const RrmProgress& progress)
        : options_(options), progress_(progress), device_(compute::open(options.device)),
          file_(options.resume,
                [this](const std::string& line) { known_.push_back(parse_rrm_row(line)); }) {}

    std::vector<RrmRow> operator()() {
        for (const RrmCase& one : kCases) {
            if (!is_wanted(one.name) || !is_there(one.name, one.scene))
                continue;
            progress_.note(fmt::format("loading {}", one.scene));
            const RrmScene scene(options_, device_, std::string(one.scene));
            const std::uint32_t depth = one.secondary ? options_.depth : 0;
            const RrmMethod rings{"lowres_rings", options_.n, scene.ring_edges(options_.n)};
            speed(one.name, one.scene, scene, depth, {{"rrm", options_.n}, rings});
            if (options_.sweep && one.scene == "bunny_5k") // as in the paper's figure 9
                sweep(one.scene, scene, depth);
            if (options_.quality && one.scene == "bunny_5k")
                quality(one.scene, scene, depth);
        }
        if (options_.quality && options_.cases.empty())
            moving_quality();
        if (is_wanted(kPhysics)) {
            for (const char* scene : kPhysicsScenes)
                if (is_there(kPhysics, scene))
                    physics(scene);
        }
        return all_;
    }

  private:
    bool is_wanted(std::string_view name) const {
        return options_.cases.empty() || std::find(options_.cases.begin(), options_.cases.end(),
                                                   name) != options_.cases.end();
    }

    // Scenes that are no built-in ones lie in files that may be absent.
    bool is_there(std::string_view name, std::string_view scene) const {
        if (!scene.starts_with("bunny") ||
            !scene_or(std::string(scene), "", options_.scene_path).empty())
            return true;
        progress_.skipped(std::string(name),
                          fmt::format("the mesh of {} lies in none of the scene folders", scene));
        return false;
    }

    RrmRow blank(std::string_view name, const RrmMethod& method, std::string_view scene,
                 const RrmScene& at, std::uint32_t depth) const {
        RrmRow row = blank(name, scene);
        row.method = method.name;
        row.n = method.n;
        row.ring_edges = method.ring_edges;
        row.depth = depth;
        row.display = at.display().name;
        row.width = at.display().width;
        row.height = at.display().height;
        row.columns = options_.columns;
        row.rows = options_.rows;
        row.frames = options_.frames;
        row.warm_up = options_.warm_up;
        row.seed = options_.seed;
        row.fovea = options_.fovea;
        return row;
    }

    RrmRow blank(std::string_view name, std::string_view scene) const {
        RrmRow row;
        row.name = name;
        row.scene = scene;
        row.device = device_.facts().name;
        row.driver = device_.facts().driver_version;
        row.commit = MACULA_COMMIT;
        return row;
    }

    void speed(std::string_view name, std::string_view scene, const RrmScene& at,
               std::uint32_t depth, const std::vector<RrmMethod>& methods) {
        std::vector<RrmRow> rows;
        std::vector<RrmMethod> missing;
        for (const RrmMethod& method : methods) {
            if (take(blank(name, method, scene, at, depth)))
                continue;
            rows.push_back(blank(name, method, scene, at, depth));
            missing.push_back(method);
        }
        if (rows.empty())
            return;
        const auto speeds = measure_speed(at, options_, missing, depth, noted(name));
        for (std::size_t i = 0; i < rows.size(); ++i) {
            rows[i].speed = speeds[i];
            keep(rows[i]);
        }
    }

    // All in turn beside the same frames of `full`.
    void sweep(std::string_view scene, const RrmScene& at, std::uint32_t depth) {
        std::vector<RrmMethod> methods;
        for (const std::uint32_t n : kSweep)
            methods.push_back({"rrm", n});
        speed("sweep", scene, at, depth, methods);
    }

    void quality(std::string_view scene, const RrmScene& at, std::uint32_t depth) {
        std::vector<RrmRow> rows;
        std::vector<RrmMethod> missing;
        std::vector<RrmMethod> methods = {
            {"lowres_rings", kQuality.front(), at.ring_edges(kQuality.front())}};
        for (const std::uint32_t n : kQuality)
            methods.push_back({"rrm", n});
        for (const RrmMethod& method : methods) {
            RrmRow row = blank("quality", method, scene, at, depth);
            row.columns = row.rows = 0;
            row.frames = options_.quality_frames;
            row.gaze = options_.gaze;
            if (take(row))
                continue;
            rows.push_back(row);
            missing.push_back(method);
        }
        if (rows.empty())
            return;
        const auto scores =
            measure_quality(at, options_, missing, depth, kQuality.back(), noted("quality"));
        for (std::size_t i = 0; i < rows.size(); ++i) {
            rows[i].quality = scores[i];
            keep(rows[i]);
        }
    }

    // The same where objects move.
    void moving_quality() {
        constexpr const char* kScene = "whitted_moving";
        progress_.note(fmt::format("loading {}", kScene));
        const RrmScene scene(options_, device_, kScene);
        quality(kScene, scene, 1);
    }

    void physics(const char* scene) {
        RrmRow row = blank(kPhysics, scene);
        row.frames = options_.physics_frames;
        if (take(row))
            return;
        progress_.note(fmt::format("physics of {}", scene));
        PhysicsOptions physics;
        physics.frames = options_.physics_frames;
        row.physics = measure_physics(load_fly_through(scene, options_.scene_path), physics);
        keep(row);
    }

    RrmNote noted(std::string_view name) const {
        return [this, name = std::string(name)](const std::string& line) {
            progress_.note(fmt::format("{}: {}", name, line));
        };
    }

    bool take(const RrmRow& wanted) {
        const auto at = std::find_if(known_.begin(), known_.end(),
                                     [&](const RrmRow& row) { return key(row) == key(wanted); });
        if (at == known_.end())
            return false;
        all_.push_back(*at);
        progress_.row(*at, false);
        return true;
    }

    void keep(const RrmRow& row) {
        file_.add(json_line(row));
        all_.push_back(row);
        progress_.row(row, true);
    }

    const RrmOptions& options_;
    const RrmProgress& progress_;
    compute::Device device_;
    std::vector<RrmRow> known_; // filled while file_ is made
    LineFile file_;
    std::vector<RrmRow> all_;
};

} // namespace

std::span<const RrmCase> rrm_cases() {
    return kCases;
}

std::vector<RrmRow> run_rrm(const RrmOptions& options, const RrmProgress& progress) {
    check(options);
    return Run(options, progress)();
}

} // namespace macula::bench
