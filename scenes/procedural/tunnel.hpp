// The loop that both tunnels of the user study share.
#pragma once

#include "scenes/scene.hpp"

namespace macula::scene::procedural {

inline constexpr float kTunnelRadius = 3.0f; // metres, before any displacement

// The centre line at `turn` of the loop, about 110 m long, and its frame: right points away from
// the loop's middle, up is +y, forward runs along the loop.
struct TunnelFrame {
    glm::vec3 centre, right, up, forward;
};
TunnelFrame tunnel_frame(float turn);

// Lamps under the tunnel's roof, the camera in its entrance and a path once round the loop.
void furnish_tunnel(Scene& scene, float sway);

} // namespace macula::scene::procedural
