// Painters of natural and woven materials: one periodic unit square each, sRGB colours, heights for
// normal maps. All are pure functions of (u, v) and a seed.
#pragma once

#include "scenes/procedural/textures.hpp"

namespace macula::scene::procedural {

// Where (u, v) lies in a wall of columns x rows bricks, odd rows shifted by half a brick (when
// `bond`): brick number, position in the brick 0..1, distance to its edge in rows.
struct Brick {
    glm::ivec2 id;
    glm::vec2 inside;
    float edge;
};
Brick brick_at(glm::vec2 uv, glm::ivec2 count, bool bond);

// Dressed blocks with narrow joints.
Texel ashlar(glm::vec2 uv, glm::vec3 colour, std::uint32_t seed);
Texel bricks(glm::vec2 uv, glm::vec3 colour, std::uint32_t seed);
// Fine-grained stone with pits and faint veins.
Texel limestone(glm::vec2 uv, glm::vec3 colour, std::uint32_t seed);
Texel plaster(glm::vec2 uv, glm::vec3 colour, std::uint32_t seed);
// Polished squares of two marbles, with a border lozenge at the crossings.
Texel marble_floor(glm::vec2 uv, std::uint32_t seed);
Texel slabs(glm::vec2 uv, glm::vec3 colour, std::uint32_t seed);
Texel terracotta(glm::vec2 uv, std::uint32_t seed);
Texel asphalt(glm::vec2 uv, glm::vec3 colour, std::uint32_t seed);
// Boards along v.
Texel planks(glm::vec2 uv, glm::vec3 colour, int boards, std::uint32_t seed);
Texel bark(glm::vec2 uv, glm::vec3 colour, std::uint32_t seed);
Texel hammered_metal(glm::vec2 uv, glm::vec3 colour, std::uint32_t seed);
// Woven damask: an ornament of `accent` on `base`.
Texel damask(glm::vec2 uv, glm::vec3 base, glm::vec3 accent, std::uint32_t seed);
// Canvas with stripes along v.
Texel striped_canvas(glm::vec2 uv, glm::vec3 a, glm::vec3 b, std::uint32_t seed);
Texel water(glm::vec2 uv, std::uint32_t seed);

// Cut-outs: alpha 0 outside the shape, its colour everywhere.
Texel ivy_leaf(glm::vec2 uv, std::uint32_t seed);
// A pinnate leaf, stem at v = 0.
Texel frond(glm::vec2 uv, std::uint32_t seed);
// A spray of several small leaves on twigs, stem at v = 0.
Texel leaf_spray(glm::vec2 uv, glm::vec3 colour, std::uint32_t seed);
// Links along v, two to a repeat.
Texel chain(glm::vec2 uv);

} // namespace macula::scene::procedural
