#include <stdexcept>

#include <nlohmann/json.hpp>

#include "bench/thesis.hpp"

namespace macula::bench {
namespace {

// By how their names begin; the rest is ray tracing.
constexpr std::array kStages = {
    std::pair{std::string_view("place "), ThesisStage::remap}, // but for the fovea: 2 us
    std::pair{std::string_view("remap"), ThesisStage::remap},
    std::pair{std::string_view("summarise texels"), ThesisStage::remap},
    std::pair{std::string_view("follow surfaces"), ThesisStage::taa},
    std::pair{std::string_view("smooth over frames"), ThesisStage::taa},
    std::pair{std::string_view("split colour"), ThesisStage::upscale},
    std::pair{std::string_view("upscale"), ThesisStage::upscale},
    std::pair{std::string_view("sharpen"), ThesisStage::upscale},
};

nlohmann::ordered_json number(const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

std::optional<double> optional_number(const nlohmann::json& json, const char* key) {
    const auto& value = json.at(key);
    return value.is_null() ? std::nullopt : std::optional(value.get<double>());
}

// 0 is what the thesis does not have.
nlohmann::ordered_json thesis_number(double value) {
    return number(value > 0.0 ? std::optional(value) : std::nullopt);
}

double thesis_flip(const ThesisRow& r) {
    for (const ThesisView& view : thesis_views()) {
        if (view.scene == r.scene && view.view == r.view && !r.disk)
            return thesis_flip(view, r.mode);
    }
    return 0.0;
}

} // namespace

const char* name(ThesisStage stage) {
    constexpr std::array<const char*, kThesisStages> names = {"ray_tracing", "remap", "taa",
                                                              "upscale"};
    return names[static_cast<std::size_t>(stage)];
}

ThesisStage thesis_stage(std::string_view stage) {
    for (const auto& [begin, group] : kStages) {
        if (stage.starts_with(begin))
            return group;
    }
    return ThesisStage::ray_tracing;
}

std::string json_line(const ThesisRow& r) {
    nlohmann::ordered_json stages;
    for (std::size_t i = 0; i < kThesisStages; ++i)
        stages[name(static_cast<ThesisStage>(i))] = r.stage_ms[i];
    return nlohmann::ordered_json{{"scene", r.scene},
                                  {"view", r.view},
                                  {"mode", r.mode},
                                  {"stand_in", r.ours},
                                  {"lights", frame::name(r.lights)},
                                  {"width", r.width},
                                  {"height", r.height},
                                  {"frames", r.frames},
                                  {"warm_up", r.warm_up},
                                  {"ms", r.ms},
                                  {"stage_ms", stages},
                                  {"samples", r.samples},
                                  {"rays", r.rays},
                                  {"flip_weighted_median", r.flip_weighted_median},
                                  {"flip_mean", r.flip_mean},
                                  {"flicker", number(r.flicker)},
                                  {"instability", number(r.instability)},
                                  {"flicker_still", r.flicker_still},
                                  {"disk", number(r.disk)},
                                  {"predicted_samples", number(r.predicted)},
                                  {"thesis_ms", thesis_number(r.disk ? 0.0 : thesis_ms(r.mode))},
                                  {"thesis_flip_weighted_median", thesis_number(thesis_flip(r))},
                                  {"device", r.device},
                                  {"driver", r.driver},
                                  {"commit", r.commit}}
        .dump();
}

ThesisRow parse_thesis_row(const std::string& line) {
    try {
        const auto json = nlohmann::json::parse(line);
        ThesisRow r;
        const auto read = [&](const char* key, auto& value) { json.at(key).get_to(value); };
        read("scene", r.scene);
        read("view", r.view);
        read("mode", r.mode);
        read("stand_in", r.ours);
        const auto lights = frame::parse_light_mode(json.at("lights").get<std::string>());
        if (!lights)
            throw std::invalid_argument("\"lights\" is none of the light modes");
        r.lights = *lights;
        read("width", r.width);
        read("height", r.height);
        read("frames", r.frames);
        read("warm_up", r.warm_up);
        read("ms", r.ms);
        for (std::size_t i = 0; i < kThesisStages; ++i)
            json.at("stage_ms").at(name(static_cast<ThesisStage>(i))).get_to(r.stage_ms[i]);
        read("samples", r.samples);
        read("rays", r.rays);
        read("flip_weighted_median", r.flip_weighted_median);
        read("flip_mean", r.flip_mean);
        r.flicker = optional_number(json, "flicker");
        r.instability = optional_number(json, "instability");
        read("flicker_still", r.flicker_still);
        r.disk = optional_number(json, "disk");
        r.predicted = optional_number(json, "predicted_samples");
        read("device", r.device);
        read("driver", r.driver);
        read("commit", r.commit);
        return r;
    } catch (const nlohmann::json::exception& error) {
        throw std::invalid_argument(error.what());
    }
}

} // namespace macula::bench
