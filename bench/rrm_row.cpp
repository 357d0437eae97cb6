#include <stdexcept>

#include <nlohmann/json.hpp>

#include "bench/rrm.hpp"

namespace macula::bench {
namespace {

using Json = nlohmann::ordered_json;

void add(Json& line, const RrmSpeed& s) {
    Json groups;
    for (std::size_t i = 0; i < kStageGroups; ++i)
        groups[name(static_cast<StageGroup>(i))] = s.ms[i];
    line.update(Json{{"fps_full", s.fps_full()},
                     {"fps_ours", s.fps_ours()},
                     {"speedup", s.speedup()},
                     {"mean_rate_ours", s.mean_rate},
                     {"efficiency", s.efficiency()},
                     {"clock", s.device_clock ? "device" : "wall"},
                     {"ms_full", s.ms_full},
                     {"ms_ours", s.ms_ours},
                     {"ms", groups},
                     {"wall_ms_full", s.wall_ms_full},
                     {"wall_ms_ours", s.wall_ms_ours},
                     {"wall_speedup", s.wall_speedup()},
                     {"samples_full", s.samples_full},
                     {"samples_ours", s.samples_ours},
                     {"rays_full", s.rays_full},
                     {"rays_ours", s.rays_ours}});
}

RrmSpeed speed_of(const nlohmann::json& json) {
    RrmSpeed s;
    const auto read = [&](const char* key, auto& value) { json.at(key).get_to(value); };
    s.device_clock = json.at("clock").get<std::string>() == "device";
    read("ms_full", s.ms_full);
    read("ms_ours", s.ms_ours);
    read("mean_rate_ours", s.mean_rate);
    for (std::size_t i = 0; i < kStageGroups; ++i)
        json.at("ms").at(name(static_cast<StageGroup>(i))).get_to(s.ms[i]);
    read("wall_ms_full", s.wall_ms_full);
    read("wall_ms_ours", s.wall_ms_ours);
    read("samples_full", s.samples_full);
    read("samples_ours", s.samples_ours);
    read("rays_full", s.rays_full);
    read("rays_ours", s.rays_ours);
    return s;
}

void add(Json& line, const RrmQuality& q) {
    line.update(Json{{"flip", q.flip},
                     {"foveated_flip", q.foveated_flip},
                     {"flicker", q.flicker},
                     {"instability", q.instability},
                     {"samples_ours", q.samples}});
}

RrmQuality quality_of(const nlohmann::json& json) {
    const auto number = [&](const char* key) { return json.at(key).get<double>(); };
    return {number("flip"), number("foveated_flip"), number("flicker"), number("instability"),
            number("samples_ours")};
}

void add(Json& line, const PhysicsResult& p) {
    line.update(Json{{"gazes", p.gazes},
                     {"ms_exact", p.ms_exact},
                     {"ms_perceptual", p.ms_perceptual},
                     {"speedup", p.speedup},
                     {"ms_coarse", p.ms_coarse},
                     {"speedup_coarse", p.speedup_coarse},
                     {"penetration_exact", p.penetration_exact},
                     {"penetration_perceptual", p.penetration_perceptual},
                     {"penetration_bound", p.bound}});
}

PhysicsResult physics_of(const nlohmann::json& json) {
    PhysicsResult p;
    const auto read = [&](const char* key, auto& value) { json.at(key).get_to(value); };
    read("frames", p.frames);
    read("gazes", p.gazes);
    read("ms_exact", p.ms_exact);
    read("ms_perceptual", p.ms_perceptual);
    read("speedup", p.speedup);
    read("ms_coarse", p.ms_coarse);
    read("speedup_coarse", p.speedup_coarse);
    read("penetration_exact", p.penetration_exact);
    read("penetration_perceptual", p.penetration_perceptual);
    read("penetration_bound", p.bound);
    return p;
}

} // namespace

std::string json_line(const RrmRow& r) {
    Json line{{"case", r.name},
              {"method", r.method},
              {"scene", r.scene},
              {"n", r.n},
              {"depth", r.depth},
              {"display", r.display},
              {"width", r.width},
              {"height", r.height},
              {"positions", r.columns * r.rows},
              {"columns", r.columns},
              {"rows", r.rows},
              {"frames", r.frames},
              {"warm_up", r.warm_up},
              {"seed", r.seed},
              {"fovea", r.fovea},
              {"gaze", r.gaze},
              {"ring_edges", r.ring_edges}};
    if (r.speed)
        add(line, *r.speed);
    if (r.quality)
        add(line, *r.quality);
    if (r.physics)
        add(line, *r.physics);
    line.update(Json{{"device", r.device}, {"driver", r.driver}, {"commit", r.commit}});
    return line.dump();
}

RrmRow parse_rrm_row(const std::string& line) {
    try {
        const auto json = nlohmann::json::parse(line);
        RrmRow r;
        const auto read = [&](const char* key, auto& value) { json.at(key).get_to(value); };
        read("case", r.name);
        read("method", r.method);
        read("scene", r.scene);
        read("n", r.n);
        read("depth", r.depth);
        read("display", r.display);
        read("width", r.width);
        read("height", r.height);
        read("columns", r.columns);
        read("rows", r.rows);
        read("frames", r.frames);
        read("warm_up", r.warm_up);
        read("seed", r.seed);
        read("fovea", r.fovea);
        read("gaze", r.gaze);
        read("ring_edges", r.ring_edges);
        if (json.contains("fps_full"))
            r.speed = speed_of(json);
        if (json.contains("foveated_flip"))
            r.quality = quality_of(json);
        if (json.contains("ms_exact"))
            r.physics = physics_of(json);
        read("device", r.device);
        read("driver", r.driver);
        read("commit", r.commit);
        return r;
    } catch (const nlohmann::json::exception& error) {
        throw std::invalid_argument(error.what());
    }
}

} // namespace macula::bench
