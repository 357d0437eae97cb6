#include "bench/quality_cases.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "bench/quality_pictures.hpp"
#include "bench/quality_scores.hpp"
#include "host/method/method.hpp"
#include "host/metric/statistics.hpp"

namespace macula::bench {
namespace {

constexpr double kEqualTime = 0.03; // part by which the time of lowres may differ
constexpr int kTries = 5;
constexpr double kLeastScale = 0.02;
constexpr double kDefaultR0 = 10.0; // degrees, of methods without a region

report::Percentiles percentiles(const std::vector<double>& values) {
    return {metric::median(values), metric::percentile(values, 0.95),
            metric::percentile(values, 0.99)};
}

// 0.05 and not 0.05000000074505806.
double short_double(float value) {
    return std::stod(fmt::format("{}", value));
}

// JSON has no infinity.
std::optional<double> finite(float degrees) {
    return std::isfinite(degrees) ? std::optional(short_double(degrees)) : std::nullopt;
}

template <class T>
std::vector<T> or_default(std::vector<T> values, std::vector<T> otherwise) {
    return values.empty() ? otherwise : values;
}

void check_word(const char* option, const std::string& word,
                const std::vector<std::string>& known) {
    if (std::find(known.begin(), known.end(), word) == known.end())
        throw std::invalid_argument(
            fmt::format("{} \"{}\": one of {} was expected", option, word, fmt::join(known, ", ")));
}

} // namespace

std::string QualityRequest::name() const {
    if (method == "full")
        return spp == 1 ? "full" : fmt::format("full, {} spp", spp);
    if (!weier)
        return method;
    if (method == "weier")
        return "weier " + weier->name();
    return weier->name() == "medium" ? fmt::format("lowres, equal {}", equal)
                                     : fmt::format("lowres, equal {}, {}", equal, weier->name());
}

std::vector<QualityRequest> quality_requests(const QualityOptions& options) {
    const std::vector<std::string> equals = {"samples", "time"};
    const auto methods = or_default(options.methods, {"full", "weier", "lowres"});
    const auto all_weier = or_default(options.weier, {QualityWeier{}});
    for (const std::string& method : methods)
        method::find_method(method);
    for (const std::string& equal : options.equal)
        check_word("--equal", equal, equals);
    const auto asked = [&](const std::string& method) {
        return std::find(methods.begin(), methods.end(), method) != methods.end();
    };
    std::vector<QualityRequest> requests;
    if (asked("full")) {
        for (const std::uint32_t spp : or_default(options.spp, {1u}))
            requests.push_back({"full", spp, std::nullopt, ""});
    }
    for (const QualityWeier& weier : all_weier) {
        if (asked("weier"))
            requests.push_back({"weier", 1, weier, ""});
        if (!asked("lowres"))
            continue;
        for (const std::string& equal : or_default(options.equal, equals))
            requests.push_back({"lowres", 1, weier, equal});
    }
    for (const std::string& method : methods) {
        if (method != "full" && method != "weier" && method != "lowres")
            requests.push_back({method, 1, std::nullopt, ""});
    }
    return requests;
}

QualityGroup::QualityGroup(const QualityFlight& flight, const QualityOptions& options,
                           frame::LightMode lights, const QualityProgress& progress)
    : flight_(flight), options_(options), lights_(lights), progress_(progress),
      references_(flight, options, lights) {}

report::QualityCase QualityGroup::blank(const QualityRequest& request) const {
    report::QualityCase result = flight_.blank();
    result.lights = frame::name(lights_);
    result.light_samples = options_.light_samples.value_or(frame::default_light_samples(lights_));
    result.method = request.method;
    result.name = request.name();
    report::Parameters& p = result.parameters;
    if (request.method == "full")
        p.spp = request.spp;
    if (!request.weier)
        return result;
    p.frc = request.weier->frc;
    p.p_min = short_double(request.weier->options.p_min);
    p.r0 = finite(request.weier->options.r0);
    p.r1 = finite(request.weier->options.r1);
    if (!request.weier->changes.empty())
        p.changes = request.weier->changes;
    if (request.method == "lowres") {
        p.equal = request.equal;
        p.equal_to = QualityRequest{"weier", 1, request.weier, ""}.name();
    }
    return result;
}

render::Renderer QualityGroup::make(const QualityRequest& request, double scale) const {
    return flight_.make(lights_, [&](render::Options& engine) {
        engine.method = request.method;
        engine.samples_per_pixel = request.spp;
        engine.lowres_scale = static_cast<float>(scale);
        if (request.weier)
            engine.weier = request.weier->options;
    });
}

Sequence QualityGroup::fly_equal(const QualityRequest& request, report::Parameters& parameters) {
    const std::string name = request.weier->name();
    if (!weier_samples_.contains(name)) {
        render::Renderer weier = make({"weier", 1, request.weier, ""}, 1.0);
        weier_samples_[name] = flight_.fly({&weier, 1}).front().samples;
    }
    const scene::Display& display = flight_.display();
    const double pixels = static_cast<double>(display.width) * display.height;
    parameters.scale = std::clamp(std::sqrt(weier_samples_[name] / pixels), kLeastScale, 1.0);
    if (request.equal == "time")
        return fly_equal_time(request, parameters);
    render::Renderer lowres = make(request, *parameters.scale);
    return std::move(flight_.fly({&lowres, 1}).front());
}

// The time grows with the samples, and has a part that does not: a few steps come close.
Sequence QualityGroup::fly_equal_time(const QualityRequest& request,
                                      report::Parameters& parameters) {
    for (int tries = 1;; ++tries) {
        std::vector<render::Renderer> both;
        both.push_back(make({"weier", 1, request.weier, ""}, 1.0));
        both.push_back(make(request, *parameters.scale));
        std::vector<Sequence> flown = flight_.fly(both);
        const double ratio = metric::median(metric::ratios(flown[1].ms(), flown[0].ms()));
        parameters.time_ratio = ratio;
        progress_.note(fmt::format("{}, {}: at scale {:.3f} {:.2f} of the time", flight_.name(),
                                   request.name(), *parameters.scale, ratio));
        const double better = std::clamp(*parameters.scale / std::sqrt(ratio), kLeastScale, 1.0);
        if (std::fabs(ratio - 1.0) < kEqualTime || better == *parameters.scale || tries == kTries)
            return std::move(flown[1]);
        parameters.scale = better;
    }
}

void QualityGroup::score(report::QualityCase& result, const Sequence& sequence) {
    const double r0 = result.parameters.frc ? result.parameters.r0.value_or(180.0) : kDefaultR0;
    QualityScores scores(flight_.display(), result.pixels_per_degree, r0);
    const auto spots = flight_.spots();
    for (std::uint32_t i = 0; i < spots.size(); ++i) {
        const ReferenceFrame reference = references_.at(spots[i].frame);
        const glm::dvec3 look = flight_.view().at(spots[i].frame).look;
        const metric::ScalarMap flip = scores.add(spots[i], reference, sequence.pictures[i], look);
        if (!options_.results.empty() && is_pictured(i, options_.frames, options_.pictures))
            add_picture(result, options_.results.parent_path(), spots[i].frame, flight_.display(),
                        look, reference.converged, sequence.pictures[i], flip);
    }
    scores.fill(result);
}

report::QualityCase QualityGroup::run(const QualityRequest& request) {
    report::QualityCase result = blank(request);
    Sequence sequence;
    if (request.method == "lowres") {
        sequence = fly_equal(request, result.parameters);
    } else {
        render::Renderer renderer = make(request, 1.0);
        sequence = std::move(flight_.fly({&renderer, 1}).front());
    }
    result.clock = sequence.has_device_clock() ? "device" : "wall";
    result.time_ms = percentiles(sequence.ms());
    result.wall_ms = percentiles(sequence.wall_ms);
    result.stages = sequence.stages;
    result.samples = sequence.samples;
    result.rays = sequence.rays;
    if (request.method == "weier")
        weier_samples_[request.weier->name()] = sequence.samples;
    progress_.note(fmt::format("{}, {}: scores", flight_.name(), request.name()));
    score(result, sequence);
    result.series.ms = sequence.ms();
    return result;
}

} // namespace macula::bench
