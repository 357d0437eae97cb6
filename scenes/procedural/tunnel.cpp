#include "scenes/procedural/tunnel.hpp"

#include <vector>

#include "scenes/procedural/path.hpp"
#include "scenes/procedural/random.hpp"

namespace macula::scene::procedural {
namespace {

constexpr int kLamps = 4;
constexpr int kWaypoints = 48;

glm::vec3 centre_line(float turn) {
    const glm::vec2 round = sin_cos_turns(turn), wave = sin_cos_turns(3.0f * turn),
                    swell = sin_cos_turns(2.0f * turn + 0.1f);
    const float radius = 17.0f + 2.2f * wave.x;
    return {radius * round.x, 1.6f * swell.y, -radius * round.y};
}

} // namespace

TunnelFrame tunnel_frame(float turn) {
    constexpr float kStep = 1.0f / 512.0f;
    TunnelFrame frame;
    frame.centre = centre_line(turn);
    frame.forward = glm::normalize(centre_line(turn + kStep) - centre_line(turn - kStep));
    frame.right = glm::normalize(glm::cross(frame.forward, glm::vec3{0, 1, 0}));
    frame.up = glm::cross(frame.right, frame.forward);
    return frame;
}

void furnish_tunnel(Scene& scene, float sway) {
    for (int i = 0; i < kLamps; ++i) {
        const float turn = (static_cast<float>(i) + 0.35f) / kLamps;
        const TunnelFrame frame = tunnel_frame(turn);
        Light lamp;
        lamp.kind = LightKind::point;
        lamp.position = frame.centre + frame.up * (0.45f * kTunnelRadius);
        // Not attenuated, as the paper's Phong: the loop's bends keep each lamp to its own part.
        lamp.colour = i % 2 == 0 ? glm::vec3{0.85f, 0.75f, 0.6f} : glm::vec3{0.65f, 0.74f, 0.85f};
        lamp.radius = 0.15f;
        scene.lights.push_back(lamp);
    }
    std::vector<Waypoint> waypoints;
    for (int i = 0; i < kWaypoints; ++i) {
        const float turn = static_cast<float>(i) / kWaypoints;
        const TunnelFrame here = tunnel_frame(turn), ahead = tunnel_frame(turn + 0.06f);
        const glm::vec2 drift = sin_cos_turns(5.0f * turn), look = sin_cos_turns(7.0f * turn);
        waypoints.push_back(
            {here.centre + here.right * (sway * drift.x) + here.up * (sway * drift.y),
             ahead.centre + ahead.right * (0.5f * look.x)});
    }
    scene.path = fly_through(waypoints, true);
    scene.cameras.push_back({"entrance", waypoints[0].eye, waypoints[0].target, {0, 1, 0}, 75.0f});
    scene.ambient = glm::vec3{0.2f};
    scene.ambient_occlusion_radius = 1.5f;
}

} // namespace macula::scene::procedural
