// Stone, fired clay, wood and metal.
#include <cmath>

#include "scenes/procedural/patterns.hpp"
#include "scenes/procedural/random.hpp"

namespace macula::scene::procedural {
namespace {

float brick_tone(glm::ivec2 id, std::uint32_t seed) {
    return unit_float(
        hash(static_cast<std::uint32_t>(id.x), static_cast<std::uint32_t>(id.y), 3u, seed));
}

glm::vec3 tinted(glm::vec3 colour, float brightness, float warmth) {
    return colour * brightness * glm::vec3{1.0f + 0.05f * warmth, 1.0f, 1.0f - 0.07f * warmth};
}

} // namespace

Brick brick_at(glm::vec2 uv, glm::ivec2 count, bool bond) {
    const float v = uv.y * static_cast<float>(count.y);
    const int row = static_cast<int>(std::floor(v));
    const float shift = bond && row % 2 != 0 ? 0.5f : 0.0f;
    const float u = uv.x * static_cast<float>(count.x) + shift;
    const int column = static_cast<int>(std::floor(u));
    Brick brick{{column % count.x, row % count.y},
                {u - static_cast<float>(column), v - static_cast<float>(row)},
                0.0f};
    const float aspect = static_cast<float>(count.y) / static_cast<float>(count.x);
    brick.edge = std::min(std::min(brick.inside.x, 1.0f - brick.inside.x) * aspect,
                          std::min(brick.inside.y, 1.0f - brick.inside.y));
    return brick;
}

Texel limestone(glm::vec2 uv, glm::vec3 colour, std::uint32_t seed) {
    const float broad = tiled_fractal(uv, 4, 4, seed), fine = tiled_fractal(uv, 48, 3, seed + 11);
    const float pits = smooth_step(0.38f, 0.62f, tiled_noise(uv, 64, seed + 23));
    const float vein_noise = std::fabs(tiled_fractal(uv, 5, 4, seed + 31));
    const float vein = 1.0f - smooth_step(0.0f, 0.06f, vein_noise);
    const float brightness = 1.0f + 0.10f * broad + 0.06f * fine - 0.12f * pits - 0.08f * vein;
    return {tinted(colour, brightness, tiled_noise(uv, 3, seed + 41)),
            0.3f * fine + 0.2f * broad - 0.8f * pits};
}

Texel ashlar(glm::vec2 uv, glm::vec3 colour, std::uint32_t seed) {
    const glm::vec2 wobble{0.004f * tiled_noise(uv, 12, seed + 5),
                           0.004f * tiled_noise(uv, 12, seed + 6)};
    const Brick block = brick_at(uv + wobble + 1.0f, {4, 8}, true);
    const float joint = smooth_step(0.02f, 0.055f, block.edge);
    const float tone = brick_tone(block.id, seed);
    const Texel stone = limestone(uv, colour, seed + 60);
    const glm::vec3 face = stone.colour * (0.84f + 0.22f * tone);
    return {glm::mix(colour * 0.58f, face, joint),
            joint + 0.12f * stone.height + 0.12f * (tone - 0.5f)};
}

Texel bricks(glm::vec2 uv, glm::vec3 colour, std::uint32_t seed) {
    const glm::vec2 wobble{0.003f * tiled_noise(uv, 24, seed + 5),
                           0.003f * tiled_noise(uv, 24, seed + 6)};
    const Brick brick = brick_at(uv + wobble + 1.0f, {6, 18}, true);
    const float joint = smooth_step(0.05f, 0.14f, brick.edge);
    const float tone = brick_tone(brick.id, seed), grain = tiled_fractal(uv, 50, 3, seed + 9);
    const glm::vec3 fired = tinted(colour, 0.75f + 0.4f * tone + 0.12f * grain, 2.0f * tone - 1.0f);
    const glm::vec3 mortar = glm::vec3{0.66f, 0.63f, 0.57f} * (1.0f + 0.1f * grain);
    return {glm::mix(mortar, fired, joint), joint + 0.15f * grain + 0.1f * tone};
}

Texel plaster(glm::vec2 uv, glm::vec3 colour, std::uint32_t seed) {
    const float broad = tiled_fractal(uv, 3, 5, seed), trowel = tiled_fractal(uv, 14, 4, seed + 8);
    const float stain = smooth_step(0.1f, 0.6f, tiled_fractal(uv, 2, 4, seed + 17));
    const float crack = 1.0f - smooth_step(0.0f, 0.012f,
                                           std::fabs(tiled_fractal(uv, 3, 5, seed + 29)) +
                                               0.03f * smooth_step(-0.2f, 0.1f, broad));
    const float brightness = 1.0f + 0.08f * broad + 0.03f * trowel - 0.1f * stain - 0.25f * crack;
    return {tinted(colour, brightness, broad), 0.7f * trowel + 0.2f * broad - crack};
}

Texel marble_floor(glm::vec2 uv, std::uint32_t seed) {
    const Brick tile = brick_at(uv, {2, 2}, false);
    const float tone = brick_tone(tile.id, seed);
    const float warp = 0.5f * tiled_fractal(uv, 4, 5, seed + 7);
    const float veins = 1.0f - std::fabs(tiled_fractal(uv + 0.08f * warp, 5, 5, seed + 13)) * 3.0f;
    const float vein = smooth_step(0.55f, 1.0f, veins);
    const bool dark = (tile.id.x + tile.id.y) % 2 != 0;
    const glm::vec3 stone = dark ? glm::mix(rgb(0x8f3b2e), rgb(0xc98a70), vein)
                                 : glm::mix(rgb(0xe3d7c0), rgb(0xa99a86), 0.7f * vein);
    glm::vec3 colour = stone * (0.94f + 0.1f * tone + 0.1f * warp);
    // Lozenges of a third stone over the crossings.
    const glm::vec2 near = glm::abs(tile.inside - glm::round(tile.inside));
    const float lozenge = near.x + near.y;
    if (lozenge < 0.2f)
        colour = glm::mix(rgb(0x3c4a43), rgb(0x74877a), vein);
    const float joint = smooth_step(0.004f, 0.010f, tile.edge) *
                        smooth_step(0.004f, 0.012f, std::fabs(lozenge - 0.2f));
    const float kept =
        lozenge < 0.2f ? smooth_step(0.004f, 0.012f, std::fabs(lozenge - 0.2f)) : joint;
    return {colour * (0.55f + 0.45f * kept), kept};
}

Texel slabs(glm::vec2 uv, glm::vec3 colour, std::uint32_t seed) {
    const Brick slab = brick_at(uv, {3, 4}, true);
    const float joint = smooth_step(0.012f, 0.035f, slab.edge);
    const float tone = brick_tone(slab.id, seed);
    const Texel stone = limestone(uv, colour, seed + 70);
    const float wear = tiled_fractal(uv, 6, 4, seed + 80);
    return {glm::mix(colour * 0.5f, stone.colour * (0.8f + 0.25f * tone + 0.06f * wear), joint),
            joint + 0.15f * stone.height + 0.1f * wear};
}

Texel terracotta(glm::vec2 uv, std::uint32_t seed) {
    const float broad = tiled_fractal(uv, 5, 4, seed), grain = tiled_fractal(uv, 40, 3, seed + 3);
    const float lichen = smooth_step(0.25f, 0.5f, tiled_fractal(uv, 7, 5, seed + 9));
    const glm::vec3 clay = tinted(rgb(0xb5653f), 1.0f + 0.2f * broad + 0.1f * grain, broad);
    return {glm::mix(clay, rgb(0x9a8f70), 0.55f * lichen), 0.5f * grain + 0.3f * lichen};
}

Texel asphalt(glm::vec2 uv, glm::vec3 colour, std::uint32_t seed) {
    const float broad = tiled_fractal(uv, 4, 4, seed);
    const Cell grain = tiled_cells(uv, 90, seed + 3);
    const float tone = unit_float(grain.id);
    return {colour * (0.85f + 0.12f * broad + 0.3f * tone * (1.0f - grain.nearest)),
            0.6f * (1.0f - grain.nearest)};
}

Texel planks(glm::vec2 uv, glm::vec3 colour, int boards, std::uint32_t seed) {
    const float u = uv.x * static_cast<float>(boards);
    const int board = static_cast<int>(std::floor(u)) % boards;
    const float inside = u - std::floor(u);
    const float tone = brick_tone({board, 0}, seed);
    const glm::vec2 along{uv.x, uv.y + tone};
    const float bend = 0.02f * tiled_fractal(along, 4, 3, seed + 1);
    // Fibres: noise stretched along v by sampling few periods in v.
    const float fibre = tiled_noise({along.x + bend, 0.1f * along.y}, 20 * boards, seed + 4);
    const float rings =
        tiled_fractal({along.x + 2.0f * bend, 0.25f * along.y}, 4 * boards, 3, seed + 6);
    const float gap = smooth_step(0.0f, 0.04f, std::min(inside, 1.0f - inside));
    const float brightness = 0.82f + 0.25f * tone + 0.12f * fibre + 0.15f * rings;
    return {tinted(colour, brightness, rings) * (0.35f + 0.65f * gap),
            gap + 0.12f * fibre + 0.1f * rings};
}

Texel bark(glm::vec2 uv, glm::vec3 colour, std::uint32_t seed) {
    const float ridges = 1.0f - std::fabs(tiled_fractal({uv.x, 0.5f * uv.y}, 8, 4, seed));
    const float fine = tiled_fractal(uv, 24, 3, seed + 5);
    return {colour * (0.45f + 0.6f * ridges * ridges + 0.12f * fine), ridges + 0.15f * fine};
}

Texel hammered_metal(glm::vec2 uv, glm::vec3 colour, std::uint32_t seed) {
    const Cell dent = tiled_cells(uv, 12, seed);
    const float patina = smooth_step(0.0f, 0.5f, tiled_fractal(uv, 5, 5, seed + 2));
    return {glm::mix(colour, rgb(0x4a6a5c), 0.35f * patina) * (0.9f + 0.15f * dent.nearest),
            dent.nearest * dent.nearest};
}

} // namespace macula::scene::procedural
