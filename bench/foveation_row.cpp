#include <stdexcept>

#include <nlohmann/json.hpp>

#include "bench/foveation.hpp"

namespace macula::bench {

double FoveationRow::overhead() const {
    double rest = 0.0;
    for (std::size_t i = 0; i < kStageGroups; ++i) {
        if (i != static_cast<std::size_t>(StageGroup::ray_tracing))
            rest += ms[i];
    }
    return ms_full > 0.0 ? rest / ms_full : 0.0;
}

std::string json_line(const FoveationRow& r, const std::string& more) {
    nlohmann::ordered_json ms;
    for (std::size_t i = 0; i < kStageGroups; ++i)
        ms[name(static_cast<StageGroup>(i))] = r.ms[i];
    const nlohmann::ordered_json line{{"scene", r.scene},
                                      {"lights", frame::name(r.lights)},
                                      {"frc", r.frc},
                                      {"triangles", r.triangles},
                                      {"width", r.width},
                                      {"height", r.height},
                                      {"frames", r.frames},
                                      {"segments", r.segments},
                                      {"warm_up", r.warm_up},
                                      {"rays_full", r.rays_full},
                                      {"rays_ours", r.rays_ours},
                                      {"sampled", r.sampled},
                                      {"clock", r.device_clock ? "device" : "wall"},
                                      {"ms_full", r.ms_full},
                                      {"ms_ours", r.ms_ours},
                                      {"ms", ms},
                                      {"wall_ms_full", r.wall_ms_full},
                                      {"wall_ms_ours", r.wall_ms_ours},
                                      {"speedup", r.speedup},
                                      {"speedup_p10", r.speedup_p10},
                                      {"speedup_p90", r.speedup_p90},
                                      {"wall_speedup", r.wall_speedup},
                                      {"efficiency", r.efficiency},
                                      {"overhead", r.overhead()},
                                      {"gaze", r.gaze},
                                      {"device", r.device},
                                      {"driver", r.driver},
                                      {"commit", r.commit}};
    std::string text = line.dump();
    if (!more.empty())
        text.insert(text.size() - 1, "," + more);
    return text;
}

FoveationRow parse_row(const std::string& line) {
    try {
        const auto json = nlohmann::json::parse(line);
        FoveationRow r;
        const auto read = [&](const char* key, auto& value) { json.at(key).get_to(value); };
        read("scene", r.scene);
        const auto lights = frame::parse_light_mode(json.at("lights").get<std::string>());
        if (!lights)
            throw std::invalid_argument("\"lights\" is none of point, area, soft and ao");
        r.lights = *lights;
        read("frc", r.frc);
        read("triangles", r.triangles);
        read("width", r.width);
        read("height", r.height);
        read("frames", r.frames);
        read("segments", r.segments);
        read("warm_up", r.warm_up);
        read("rays_full", r.rays_full);
        read("rays_ours", r.rays_ours);
        read("sampled", r.sampled);
        r.device_clock = json.at("clock").get<std::string>() == "device";
        read("ms_full", r.ms_full);
        read("ms_ours", r.ms_ours);
        for (std::size_t i = 0; i < kStageGroups; ++i)
            json.at("ms").at(name(static_cast<StageGroup>(i))).get_to(r.ms[i]);
        read("wall_ms_full", r.wall_ms_full);
        read("wall_ms_ours", r.wall_ms_ours);
        read("speedup", r.speedup);
        read("speedup_p10", r.speedup_p10);
        read("speedup_p90", r.speedup_p90);
        read("wall_speedup", r.wall_speedup);
        read("efficiency", r.efficiency);
        read("gaze", r.gaze);
        read("device", r.device);
        read("driver", r.driver);
        read("commit", r.commit);
        return r;
    } catch (const nlohmann::json::exception& error) {
        throw std::invalid_argument(error.what());
    }
}

} // namespace macula::bench
