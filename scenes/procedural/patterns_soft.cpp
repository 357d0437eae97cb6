// Cloth, water and cut-out leaves and links.
#include <array>
#include <cmath>

#include "scenes/procedural/patterns.hpp"
#include "scenes/procedural/random.hpp"

namespace macula::scene::procedural {
namespace {

// Over-and-under of `threads` warp and weft threads, -1..1.
float weave(glm::vec2 uv, float threads) {
    const glm::vec2 p = uv * threads;
    const glm::vec2 cell = glm::floor(p), inside = p - cell - 0.5f;
    const bool over = (static_cast<int>(cell.x) + static_cast<int>(cell.y)) % 2 == 0;
    const float d = over ? inside.x : inside.y;
    return 1.0f - 8.0f * d * d;
}

// A leaf blade from (0, 0) to (0, 1): half width 0.5 * w * sin-like bulge. Positive inside.
float blade(glm::vec2 p, float width) {
    if (p.y <= 0.0f || p.y >= 1.0f)
        return -1.0f;
    const float bulge = width * 2.6f * p.y * (1.0f - p.y) * (1.0f - 0.45f * p.y);
    return bulge - std::fabs(p.x);
}

glm::vec2 turned(glm::vec2 p, float turns) {
    const glm::vec2 cs = sin_cos_turns(turns);
    return {p.x * cs.x + p.y * cs.y, p.y * cs.x - p.x * cs.y};
}

// Distance to a rounded rectangle's outline of these half sizes.
float link_distance(glm::vec2 p, glm::vec2 half, float radius) {
    const glm::vec2 q = glm::abs(p) - (half - radius);
    const float outside = glm::length(glm::max(q, glm::vec2{0.0f}));
    return std::fabs(outside + std::min(std::max(q.x, q.y), 0.0f) - radius);
}

} // namespace

Texel damask(glm::vec2 uv, glm::vec3 base, glm::vec3 accent, std::uint32_t seed) {
    // Two ornaments to a repeat, the second one shifted by half.
    float ornament = -1.0f;
    for (const glm::vec2 centre :
         {glm::vec2{0.5f, 0.5f}, glm::vec2{0.0f, 0.0f}, {1.0f, 0.0f}, {0.0f, 1.0f}, {1.0f, 1.0f}}) {
        const glm::vec2 p = (uv - centre) * 2.6f;
        const float r = glm::length(p);
        if (r < 1e-4f || r > 1.2f)
            continue;
        // Eight petals: |cos| of four times the angle, from the angle's cosine.
        const float c = p.x / r, c2 = 2.0f * c * c - 1.0f, c4 = 2.0f * c2 * c2 - 1.0f,
                    c8 = 2.0f * c4 * c4 - 1.0f;
        const float petals = 0.62f + 0.22f * c4 + 0.1f * c8;
        ornament = std::max(ornament, petals - r);
        ornament = std::max(ornament, 0.035f - std::fabs(r - 0.95f - 0.05f * c8));
        if (r < 0.3f)
            ornament = std::min(ornament, std::fabs(r - 0.2f) - 0.05f);
    }
    const float figure = smooth_step(-0.012f, 0.012f, ornament);
    const float thread = weave(uv, 128.0f), worn = tiled_fractal(uv, 4, 4, seed);
    const glm::vec3 colour =
        glm::mix(base, accent, 0.8f * figure) * (0.95f + 0.05f * thread + 0.1f * worn);
    return {colour, 0.35f * thread + 0.5f * figure};
}

Texel striped_canvas(glm::vec2 uv, glm::vec3 a, glm::vec3 b, std::uint32_t seed) {
    const float stripe = smooth_step(0.24f, 0.26f, std::fabs(uv.x - 0.5f));
    const float thread = weave(uv, 96.0f), worn = tiled_fractal(uv, 3, 5, seed);
    return {glm::mix(a, b, stripe) * (0.94f + 0.05f * thread + 0.12f * worn), 0.4f * thread};
}

Texel water(glm::vec2 uv, std::uint32_t seed) {
    const float swell = tiled_fractal(uv, 5, 4, seed);
    return {rgb(0x2c5a60) * (1.0f + 0.2f * swell), swell};
}

Texel ivy_leaf(glm::vec2 uv, std::uint32_t seed) {
    // Five lobes about the stem's end.
    const glm::vec2 p{uv.x - 0.5f, uv.y - 0.22f};
    constexpr std::array<glm::vec3, 5> kLobes{glm::vec3{0.0f, 0.76f, 0.50f},
                                              {0.16f, 0.62f, 0.46f},
                                              {-0.16f, 0.62f, 0.46f},
                                              {0.33f, 0.42f, 0.46f},
                                              {-0.33f, 0.42f, 0.46f}};
    float shape = -1.0f, midrib = 1.0f;
    for (const glm::vec3& lobe : kLobes) {
        const glm::vec2 q = turned(p, -lobe.x * 0.75f) / lobe.y;
        shape = std::max(shape, blade(q + glm::vec2{0.0f, 0.12f}, lobe.z) * lobe.y);
        if (q.y > 0.0f && q.y < 0.9f)
            midrib = std::min(midrib, std::fabs(q.x) * lobe.y);
    }
    if (p.y < 0.06f && std::fabs(p.x) < 0.018f)
        shape = std::max(shape, 0.01f);
    const float vein = 1.0f - smooth_step(0.004f, 0.022f, midrib);
    const float mottle = tiled_fractal(uv, 6, 4, seed);
    const glm::vec3 green = glm::mix(rgb(0x3f6a24), rgb(0x6f9440), 0.5f + 0.6f * mottle);
    return {glm::mix(green, rgb(0xa9bd78), 0.6f * vein), 0.4f * vein, shape > 0.0f ? 1.0f : 0.0f};
}

Texel frond(glm::vec2 uv, std::uint32_t seed) {
    const glm::vec2 p{std::fabs(uv.x - 0.5f), uv.y};
    float shape = 0.014f * (1.0f - 0.7f * p.y) - p.x, rib = std::fabs(shape);
    // Leaflets leave the stem upwards and shorten towards the tip.
    constexpr int kLeaflets = 13;
    for (int i = 0; i < kLeaflets; ++i) {
        const float at = 0.08f + 0.86f * static_cast<float>(i) / kLeaflets;
        const float length =
            0.46f * std::sqrt(std::max(0.05f, 1.0f - at)) * smooth_step(-0.15f, 0.25f, at);
        const glm::vec2 q = turned(p - glm::vec2{0.0f, at}, -0.18f) / length;
        shape = std::max(shape, blade(q, 0.11f) * length);
        if (q.y > 0.0f && q.y < 1.0f)
            rib = std::min(rib, std::fabs(q.x) * length);
    }
    const float mottle = tiled_fractal(uv, 5, 4, seed);
    const glm::vec3 green = glm::mix(rgb(0x2f5d2a), rgb(0x7da04a), 0.45f + 0.6f * mottle);
    const float vein = 1.0f - smooth_step(0.002f, 0.008f, rib);
    return {glm::mix(green, rgb(0xb4c98a), 0.5f * vein), 0.0f, shape > 0.0f ? 1.0f : 0.0f};
}

Texel leaf_spray(glm::vec2 uv, glm::vec3 colour, std::uint32_t seed) {
    float shape = 0.012f - std::fabs(uv.x - 0.5f);
    if (uv.y > 0.85f)
        shape = -1.0f;
    float tone = 0.5f;
    constexpr std::uint32_t kLeaves = 22;
    for (std::uint32_t i = 0; i < kLeaves; ++i) {
        const float r = unit_float(hash(i, 1u, 0u, seed)), s = unit_float(hash(i, 2u, 0u, seed));
        const float at = 0.1f + 0.68f * static_cast<float>(i) / kLeaves;
        const float side = i % 2 == 0 ? 1.0f : -1.0f;
        const float length = 0.30f + 0.16f * s;
        const glm::vec2 q = turned(uv - glm::vec2{0.5f, at}, -side * (0.1f + 0.1f * r)) / length;
        const float inside = blade(q, 0.26f) * length;
        if (inside > shape) {
            shape = inside;
            tone = 0.25f + 0.75f * s - 1.2f * (std::fabs(q.x) < 0.02f ? 0.15f : 0.0f);
        }
    }
    const float mottle = tiled_fractal(uv, 6, 3, seed + 3);
    return {colour * (0.65f + 0.55f * tone + 0.15f * mottle), 0.0f, shape > 0.0f ? 1.0f : 0.0f};
}

Texel chain(glm::vec2 uv) {
    constexpr float kWire = 0.085f;
    const glm::vec2 p{uv.x - 0.5f, uv.y};
    // One link seen flat, and its two neighbours seen from the edge, half a repeat away.
    const float flat = link_distance({p.x, p.y - 0.5f}, {0.30f, 0.34f}, 0.28f) - kWire;
    const float nearest_end = std::min(p.y, 1.0f - p.y);
    const float edge = std::max(std::fabs(p.x) - kWire, nearest_end - 0.34f);
    const float shape = std::min(flat, edge);
    const float shade = 1.0f - smooth_step(-kWire, 0.0f, shape);
    return {rgb(0x6f6558) * (0.55f + 0.7f * shade), shade, shape < 0.0f ? 1.0f : 0.0f};
}

} // namespace macula::scene::procedural
