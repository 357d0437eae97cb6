#include "bench/tuner.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <stdexcept>

#include "bench/device_rays.hpp"
#include "host/metric/statistics.hpp"

namespace macula::bench {
namespace {

using kernel::RayClass;

struct TuneScene {
    TuneScene(compute::Device& device, Case opened, const RayOptions& rays)
        : scene_case(std::move(opened)), geometry(device, scene_case.scene) {
        const RaySet primary = make_rays(RayClass::primary, scene_case, {}, rays);
        const EmbreeScene embree(scene_case.scene);
        EmbreeRays traced(embree, primary, EmbreeCall::packet16);
        traced.run();
        points = surface_points(scene_case, primary, traced);
    }

    Case scene_case;
    frame::DeviceGeometry geometry;
    std::vector<SurfacePoint> points;
};

// The rays of one class on every scene.
class ClassTuner {
  public:
    ClassTuner(compute::Device& device, std::vector<std::unique_ptr<TuneScene>>& scenes,
               RayClass ray_class, const TuneOptions& options)
        : device_(device), options_(options), ray_class_(ray_class) {
        for (auto& scene : scenes) {
            RaySet rays = make_rays(ray_class, scene->scene_case, scene->points, options.rays);
            if (rays.count != 0)
                loads_.push_back(std::make_unique<Load>(device, scene->geometry, std::move(rays)));
        }
        if (loads_.empty())
            throw std::runtime_error("tune: no scene gives any ray of the class " +
                                     std::string(kernel::name(ray_class)));
    }

    TuneClass tune() {
        const kernel::DeviceTraits traits = kernel::traits_of(device_);
        std::vector<TuneCandidate> all;
        for (const kernel::Variant& variant : kernel::variants()) {
            TuneCandidate candidate{{&variant, {}}, 0.0, {}};
            candidate.skipped = kernel::why_not(variant, traits, ray_class_);
            all.push_back(std::move(candidate));
        }
        measure(all);
        sort(all);
        std::vector<TuneCandidate> finalists;
        for (const TuneCandidate& candidate : all) {
            const double best = all.front().mrays_per_s;
            if (candidate.skipped.empty() && candidate.mrays_per_s * options_.worth_tuning >= best)
                finalists.push_back(tune_parameters(candidate, traits));
        }
        std::erase_if(all, [&](const TuneCandidate& c) {
            return std::any_of(finalists.begin(), finalists.end(), [&](const TuneCandidate& f) {
                return f.choice.variant == c.choice.variant;
            });
        });
        // Only figures of one interleaved run decide.
        measure(finalists);
        sort(finalists);
        finalists.insert(finalists.end(), all.begin(), all.end());
        return {ray_class_, std::move(finalists)};
    }

  private:
    struct Load {
        Load(compute::Device& device, frame::DeviceGeometry& on_device, RaySet made)
            : geometry(on_device), set(std::move(made)), rays(device, set) {}
        frame::DeviceGeometry& geometry;
        RaySet set;
        DeviceRays rays;
    };

    // One parameter after another, each starting from the best so far.
    TuneCandidate tune_parameters(TuneCandidate best, const kernel::DeviceTraits& traits) {
        for (const kernel::Parameter& parameter : best.choice.variant->parameters) {
            std::vector<TuneCandidate> tries;
            for (const std::uint32_t value :
                 values_to_try(parameter, options_.furthest, traits.max_work_group)) {
                tries.push_back({best.choice, 0.0, {}});
                tries.back().choice.parameters[parameter.name] = value;
            }
            measure(tries);
            sort(tries);
            best = tries.front();
        }
        return best;
    }

    void measure(std::vector<TuneCandidate>& candidates) {
        std::vector<double> log_seconds(candidates.size(), 0.0);
        for (const auto& load : loads_)
            measure(*load, candidates, log_seconds);
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            if (candidates[i].skipped.empty())
                candidates[i].mrays_per_s =
                    1e-6 / std::exp(log_seconds[i] / static_cast<double>(loads_.size()));
        }
    }

    // Adds the logarithm of the median seconds a ray.
    void measure(Load& load, std::vector<TuneCandidate>& candidates,
                 std::vector<double>& log_seconds) {
        std::vector<std::unique_ptr<VariantRun>> runs;
        std::vector<metric::Measurement> measurements;
        std::vector<std::size_t> measured;
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            TuneCandidate& candidate = candidates[i];
            if (!candidate.skipped.empty())
                continue;
            auto run = std::make_unique<VariantRun>(device_, load.geometry, candidate.choice);
            if (const auto reason =
                    run->warm_up(load.rays, options_.rounds, options_.limit_seconds)) {
                candidate.skipped = *reason;
                continue;
            }
            measurements.emplace_back([r = run.get(), &load] { return r->run(load.rays).wall; });
            measured.push_back(i);
            runs.push_back(std::move(run));
        }
        const auto seconds = metric::interleave(measurements, options_.rounds);
        for (std::size_t m = 0; m < measured.size(); ++m)
            log_seconds[measured[m]] += std::log(metric::median(seconds[m]) / load.set.count);
    }

    static void sort(std::vector<TuneCandidate>& candidates) {
        std::stable_sort(candidates.begin(), candidates.end(),
                         [](const TuneCandidate& a, const TuneCandidate& b) {
                             if (a.skipped.empty() != b.skipped.empty())
                                 return a.skipped.empty();
                             return a.mrays_per_s > b.mrays_per_s;
                         });
    }

    compute::Device& device_;
    const TuneOptions& options_;
    RayClass ray_class_;
    std::vector<std::unique_ptr<Load>> loads_;
};

} // namespace

TuneOptions TuneOptions::quick() {
    TuneOptions options;
    options.scenes = {"atrium"};
    options.rounds = 3;
    options.limit_seconds = 2.0;
    options.worth_tuning = 1.0;
    options.furthest = 2;
    return options;
}

std::vector<std::uint32_t> values_to_try(const kernel::Parameter& parameter, std::uint32_t furthest,
                                         std::uint32_t max_work_group) {
    std::uint32_t maximum = parameter.maximum;
    if (std::string_view(parameter.name) == "work_group")
        maximum = std::min(maximum, max_work_group);
    std::set<std::uint32_t> values;
    for (std::uint32_t step = 1; step <= furthest; step *= 2) {
        for (const std::uint64_t value :
             {std::uint64_t{parameter.standard} / step, std::uint64_t{parameter.standard} * step}) {
            if (value >= parameter.minimum && value <= maximum)
                values.insert(static_cast<std::uint32_t>(value));
        }
    }
    return {values.begin(), values.end()};
}

std::vector<TuneClass> tune(compute::Device& device, const TuneOptions& options,
                            const std::function<void(const std::string&)>& note) {
    std::vector<std::unique_ptr<TuneScene>> scenes;
    for (const std::string& name : options.scenes) {
        note("loading " + name);
        scenes.push_back(std::make_unique<TuneScene>(device, open_case(name, {}), options.rays));
    }
    std::vector<TuneClass> classes;
    for (const RayClass ray_class : kernel::kRayClasses) {
        note(std::string("measuring ") + kernel::name(ray_class) + " rays");
        classes.push_back(ClassTuner(device, scenes, ray_class, options).tune());
    }
    return classes;
}

} // namespace macula::bench
