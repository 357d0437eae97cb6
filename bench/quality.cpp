#include "bench/quality.hpp"

#include <map>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/line_file.hpp"
#include "bench/quality_cases.hpp"

namespace macula::bench {
namespace {

void check(const QualityOptions& options) {
    Schedule(options.frames, options.segments, options.warm_up, 0); // refuses what is out of range
    if (options.reference_spp < 1 || options.reference_spp > 65536)
        throw std::invalid_argument("--reference-spp must lie between 1 and 65536");
    if (options.pictures > options.frames)
        throw std::invalid_argument("--pictures must not be more than the frames");
    if (options.scenes.empty())
        throw std::invalid_argument("--scenes: which?");
}

} // namespace

std::vector<report::QualityCase> run_quality(const QualityOptions& options,
                                             const QualityProgress& progress) {
    check(options);
    const auto requests = quality_requests(options);
    const compute::Device device = compute::open(options.device);
    std::map<std::string, report::QualityCase> known;
    const LineFile file(options.results, [&](const std::string& line) {
        report::QualityCase result = report::parse_case(line);
        known.emplace(identity(result), std::move(result));
    });
    const auto lights =
        options.lights.empty() ? std::vector{frame::LightMode::area} : options.lights;
    std::vector<report::QualityCase> all;
    for (const std::string& scene : options.scenes) {
        progress.note("loading " + scene);
        const QualityFlight flight(options, device, scene);
        for (const frame::LightMode mode : lights) {
            QualityGroup group(flight, options, mode, progress);
            for (const QualityRequest& request : requests) {
                const auto found = known.find(identity(group.blank(request)));
                const bool is_new = found == known.end();
                progress.note(fmt::format("{}, {}: {}", scene, frame::name(mode), request.name()));
                all.push_back(is_new ? group.run(request) : found->second);
                if (is_new)
                    file.add(json_line(all.back()));
                progress.done(all.back(), is_new);
            }
        }
    }
    return all;
}

std::string google_benchmark(const std::vector<report::QualityCase>& cases) {
    using Json = nlohmann::ordered_json;
    const auto number = [](const std::optional<double>& value) {
        return value ? Json(*value) : Json(nullptr);
    };
    Json benchmarks = Json::array();
    for (const report::QualityCase& c : cases) {
        const std::string name = fmt::format("quality/{}/{}/{}", c.scene, c.lights, c.name);
        benchmarks.push_back({{"name", name},
                              {"run_name", name},
                              {"run_type", "iteration"},
                              {"repetitions", 1},
                              {"repetition_index", 0},
                              {"threads", 1},
                              {"iterations", c.frames},
                              {"real_time", c.wall_ms.median},
                              {"cpu_time", c.time_ms.median},
                              {"time_unit", "ms"},
                              {"samples", c.samples},
                              {"rays", c.rays},
                              {"flip", c.scores.flip.mean},
                              {"foveated_flip", c.scores.foveated_flip.mean},
                              {"psnr", number(c.scores.psnr)},
                              {"ssim", c.scores.ssim},
                              {"flicker_energy", number(c.scores.flicker_energy)},
                              {"instability", number(c.scores.instability)}});
    }
    Json context = Json::object();
    if (!cases.empty())
        context = {{"executable", "macula bench quality"}, {"device", cases.front().device},
                   {"driver", cases.front().driver},       {"commit", cases.front().commit},
                   {"width", cases.front().width},         {"height", cases.front().height}};
    return Json{{"context", std::move(context)}, {"benchmarks", std::move(benchmarks)}}.dump(2) +
           "\n";
}

} // namespace macula::bench
