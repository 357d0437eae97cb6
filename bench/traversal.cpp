#include "bench/traversal.hpp"

#include <algorithm>
#include <stdexcept>

#include "bench/compare.hpp"
#include "host/metric/statistics.hpp"

namespace macula::bench {
namespace {

using kernel::RayClass;

// One scene on the device and in Embree, with the points where its primary rays hit.
class SceneRun {
  public:
    SceneRun(const TraversalOptions& options, compute::Device& device, Case scene_case,
             TraversalReport& report)
        : options_(options), device_(device), case_(std::move(scene_case)), report_(report),
          geometry_(device, case_.scene), embree_(case_.scene, {report.threads, false}),
          reference_(device, geometry_, {&kernel::reference_variant(), {}}),
          comparison_(embree_, device, geometry_, reference_),
          chosen_(stage::choose_variants(device)) {
        const RaySet primary = make_rays(RayClass::primary, case_, {}, options.rays);
        EmbreeRays traced(embree_, primary, EmbreeCall::packet16);
        traced.run();
        points_ = surface_points(case_, primary, traced);
    }

    void trace(RayClass ray_class, const TraversalProgress& progress) {
        const RaySet rays = make_rays(ray_class, case_, points_, options_.rays);
        if (rays.count == 0) {
            progress.note(case_.name + ", " + kernel::name(ray_class) +
                          ": no rays, as no primary "
                          "ray hits anything");
            return;
        }
        DeviceRays device_rays(device_, rays);
        std::vector<Contestant> contestants = select(ray_class);
        for (Contestant& c : contestants)
            prepare(c, device_rays, progress);
        const bool any_runs = std::any_of(contestants.begin(), contestants.end(),
                                          [](const Contestant& c) { return c.run != nullptr; });
        if (any_runs)
            measure(rays, device_rays, contestants);
        for (Contestant& c : contestants)
            report_.records.push_back(std::move(c.record));
    }

  private:
    struct Contestant {
        TraversalRecord record;
        std::unique_ptr<VariantRun> run;
        RayResults results;
    };

    // The variants to run, and those that are left out with the reason.
    std::vector<Contestant> select(RayClass ray_class) {
        std::vector<Contestant> contestants;
        const kernel::DeviceTraits traits = kernel::traits_of(device_);
        const kernel::Choice& chosen = chosen_[static_cast<std::size_t>(ray_class)];
        for (const kernel::Variant& variant : kernel::variants()) {
            const auto& named = options_.variants;
            const bool is_named =
                std::find(named.begin(), named.end(), variant.name) != named.end();
            if (!named.empty() && !is_named)
                continue;
            Contestant c;
            c.record.scene = case_.name;
            c.record.rays = ray_class;
            c.record.variant = variant.name;
            c.record.chosen = chosen.variant == &variant;
            const bool is_unsafe = kernel::contains(variant.unsafe, ray_class);
            if (!(is_named && is_unsafe))
                c.record.skipped = kernel::why_not(variant, traits, ray_class);
            if (c.record.skipped.empty())
                c.run = std::make_unique<VariantRun>(
                    device_, geometry_, c.record.chosen ? chosen : kernel::Choice{&variant, {}});
            contestants.push_back(std::move(c));
        }
        return contestants;
    }

    // Builds, warms up, and takes the results; a variant that cannot run is left out.
    void prepare(Contestant& c, DeviceRays& rays, const TraversalProgress& progress) {
        if (!c.run)
            return;
        progress.note(case_.name + ", " + kernel::name(c.record.rays) + ", " + c.record.variant);
        rays.clear_results();
        if (const auto reason = c.run->warm_up(rays, options_.rounds + 1, options_.limit_seconds)) {
            c.record.skipped = *reason;
            c.run.reset();
            return;
        }
        c.results = rays.results();
    }

    // Seconds of a contestant or an Embree call, one entry a round.
    struct Series {
        std::vector<double> wall, cpu, device;
        void add(const RunTime& time) {
            wall.push_back(time.wall);
            cpu.push_back(time.cpu);
            device.push_back(time.device);
        }
    };

    void measure(const RaySet& rays, DeviceRays& device_rays,
                 std::vector<Contestant>& contestants) {
        std::vector<std::unique_ptr<EmbreeRays>> embree;
        for (const EmbreeCall call : kEmbreeCalls) {
            embree.push_back(std::make_unique<EmbreeRays>(embree_, rays, call));
            embree.back()->run();
        }
        judge(rays, *embree.front(), device_rays, contestants);
        std::vector<std::function<RunTime()>> runs;
        runs.reserve(kEmbreeCalls.size() + contestants.size());
        for (const auto& call : embree)
            runs.emplace_back([&call] { return call->run(); });
        std::vector<Contestant*> running;
        for (Contestant& c : contestants) {
            if (!c.run)
                continue;
            running.push_back(&c);
            runs.emplace_back([&c, &device_rays] { return c.run->run(device_rays); });
        }
        std::vector<Series> series(runs.size());
        std::vector<metric::Measurement> measurements;
        measurements.reserve(runs.size());
        for (std::size_t i = 0; i < runs.size(); ++i)
            measurements.emplace_back([&run = runs[i], &to = series[i]] {
                to.add(run());
                return to.wall.back();
            });
        metric::interleave(measurements, options_.rounds);
        const std::size_t best = fill_embree(rays, series, contestants);
        for (std::size_t i = 0; i < running.size(); ++i)
            fill(running[i]->record, rays, series[kEmbreeCalls.size() + i], series[best]);
    }

    // Everything is held against the reference bit for bit, and the reference against Embree; a
    // variant that differs from the reference is held against Embree itself.
    void judge(const RaySet& rays, const EmbreeRays& embree, DeviceRays& device_rays,
               std::vector<Contestant>& contestants) {
        device_rays.clear_results();
        reference_.run(device_rays);
        const RayResults expected = device_rays.results();
        const Agreement of_reference = comparison_.compare(rays, expected, embree);
        for (Contestant& c : contestants) {
            if (!c.run)
                continue;
            const std::uint32_t different =
                RayResults::differences(c.results, expected, rays.count);
            const Agreement agreement =
                different == 0 ? of_reference : comparison_.compare(rays, c.results, embree);
            c.record.mismatches_reference = different;
            c.record.mismatches_embree = agreement.mismatches;
            c.record.ties = agreement.ties;
            c.record.rounding = agreement.rounding;
            c.results = {};
        }
    }

    // Returns the index of Embree's fastest call.
    std::size_t fill_embree(const RaySet& rays, std::span<const Series> series,
                            std::vector<Contestant>& contestants) {
        std::array<double, kEmbreeCalls.size()> calls{};
        for (std::size_t i = 0; i < calls.size(); ++i)
            calls[i] = 1e-6 * rays.count / metric::median(series[i].wall);
        const auto best =
            static_cast<std::size_t>(std::max_element(calls.begin(), calls.end()) - calls.begin());
        for (Contestant& c : contestants) {
            c.record.ray_count = rays.count;
            c.record.rounds = options_.rounds;
            c.record.embree_calls = calls;
            c.record.embree_best = name(kEmbreeCalls[best]);
            c.record.embree_mrays_per_s = calls[best];
        }
        return best;
    }

    static void fill(TraversalRecord& record, const RaySet& rays, const Series& own,
                     const Series& embree) {
        record.mrays_per_s = 1e-6 * rays.count / metric::median(own.wall);
        const double device = metric::median(own.device);
        record.device_mrays_per_s = device > 0.0 ? 1e-6 * rays.count / device : 0.0;
        const std::vector<double> ratios = metric::ratios(embree.wall, own.wall);
        record.ratio = metric::median(ratios);
        record.ratio_p10 = metric::percentile(ratios, 0.1);
        record.ratio_p90 = metric::percentile(ratios, 0.9);
        record.cpu_ratio = metric::median(metric::ratios(embree.cpu, own.cpu));
    }

    const TraversalOptions& options_;
    compute::Device& device_;
    Case case_;
    TraversalReport& report_;
    frame::DeviceGeometry geometry_;
    EmbreeScene embree_;
    VariantRun reference_;
    Comparison comparison_;
    stage::VariantTable chosen_;
    std::vector<SurfacePoint> points_;
};

void check(const TraversalOptions& options) {
    if (options.rounds < 1 || options.rounds > 1000)
        throw std::invalid_argument("--rounds must lie between 1 and 1000");
    if (options.rays.size < 32 || options.rays.size > 8192)
        throw std::invalid_argument("--size must lie between 32 and 8192");
    for (const std::string& variant : options.variants)
        kernel::find_variant(variant);
}

} // namespace

TraversalReport run_traversal(const TraversalOptions& options, const TraversalProgress& progress) {
    check(options);
    compute::Device device = compute::open(options.device);
    const compute::DeviceFacts& facts = device.facts();
    TraversalReport report{facts.name,
                           facts.driver_version,
                           facts.platform_version,
                           embree_version(),
                           MACULA_COMMIT,
                           0,
                           {}};
    // Embree runs on the cores that the device has; beside a GPU, on all of the host's.
    report.threads = facts.type == compute::DeviceType::cpu ? facts.compute_units : 0;
    const auto folders = scene_folders(options.scene_path);
    std::vector<std::string> scenes = options.scenes;
    if (scenes.empty())
        scenes = default_scenes(folders);
    std::vector<RayClass> classes = options.classes;
    if (classes.empty())
        classes.assign(kernel::kRayClasses.begin(), kernel::kRayClasses.end());
    for (const std::string& name : scenes) {
        progress.note("loading " + name);
        SceneRun scene(options, device, open_case(name, folders), report);
        for (const RayClass ray_class : classes) {
            const std::size_t first_new = report.records.size();
            scene.trace(ray_class, progress);
            progress.records(report, first_new);
        }
    }
    return report;
}

} // namespace macula::bench
