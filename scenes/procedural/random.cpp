#include "scenes/procedural/random.hpp"

#include <cmath>

#include "lib/math.h"

namespace macula::scene::procedural {
namespace {

float fade(float t) {
    return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}

// The dot product of the offset with one of twelve gradients (Perlin 2002).
float gradient(std::uint32_t h, float x, float y, float z) {
    const std::uint32_t k = h & 15u;
    const float a = k < 8u ? x : y;
    const float b = k < 4u ? y : (k == 12u || k == 14u ? x : z);
    return ((k & 1u) != 0u ? -a : a) + ((k & 2u) != 0u ? -b : b);
}

// The dot product of the offset with one of eight directions of the plane.
float plane_gradient(std::uint32_t h, float x, float y) {
    static constexpr float kX[8] = {1.4f, -1.4f, 0.0f, 0.0f, 1.0f, -1.0f, 1.0f, -1.0f};
    static constexpr float kY[8] = {0.0f, 0.0f, 1.4f, -1.4f, 1.0f, 1.0f, -1.0f, -1.0f};
    return kX[h >> 29] * x + kY[h >> 29] * y;
}

int wrap(int i, int period) {
    const int m = i % period;
    return m < 0 ? m + period : m;
}

std::uint32_t word(int i) {
    return static_cast<std::uint32_t>(i);
}

} // namespace

std::uint32_t hash(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t seed) {
    std::uint32_t h = seed * 0x9e3779b9u + a;
    h = (h ^ (h >> 16)) * 0x7feb352du + b * 0x85ebca6bu;
    h = (h ^ (h >> 15)) * 0x846ca68bu + c * 0xc2b2ae35u;
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    return h ^ (h >> 16);
}

std::uint32_t fold_seed(std::uint64_t seed) {
    const auto low = static_cast<std::uint32_t>(seed),
               high = static_cast<std::uint32_t>(seed >> 32);
    return hash(low, high, 0x6d616375u, 0x6c61u);
}

Random::Random(std::uint64_t seed, std::uint32_t stream) : key_(fold_seed(seed)), stream_(stream) {}

std::uint32_t Random::bits() {
    return hash(counter_++, stream_, 0x52u, key_);
}

std::uint32_t Random::below(std::uint32_t count) {
    return static_cast<std::uint32_t>((static_cast<std::uint64_t>(bits()) * count) >> 32);
}

int Random::between(int lo, int hi) {
    return lo + static_cast<int>(below(static_cast<std::uint32_t>(hi - lo + 1)));
}

float noise(glm::vec3 p, std::uint32_t seed) {
    const glm::vec3 cell = glm::floor(p), f = p - cell;
    const int x = static_cast<int>(cell.x), y = static_cast<int>(cell.y),
              z = static_cast<int>(cell.z);
    const float u = fade(f.x), v = fade(f.y), w = fade(f.z);
    const auto corner = [&](int i, int j, int k) {
        return gradient(hash(word(x + i), word(y + j), word(z + k), seed),
                        f.x - static_cast<float>(i), f.y - static_cast<float>(j),
                        f.z - static_cast<float>(k));
    };
    const float y0 = glm::mix(glm::mix(corner(0, 0, 0), corner(1, 0, 0), u),
                              glm::mix(corner(0, 1, 0), corner(1, 1, 0), u), v);
    const float y1 = glm::mix(glm::mix(corner(0, 0, 1), corner(1, 0, 1), u),
                              glm::mix(corner(0, 1, 1), corner(1, 1, 1), u), v);
    return glm::mix(y0, y1, w);
}

float fractal_noise(glm::vec3 p, int octaves, std::uint32_t seed) {
    float sum = 0.0f, weight = 0.5f;
    for (int i = 0; i < octaves; ++i, weight *= 0.5f, p *= 2.0f)
        sum += weight * noise(p, seed + word(i));
    return sum * 1.4f;
}

float ridged_noise(glm::vec3 p, int octaves, std::uint32_t seed) {
    float sum = 0.0f, weight = 0.5f, total = 0.0f;
    for (int i = 0; i < octaves; ++i, weight *= 0.5f, p *= 2.0f) {
        const float crest = 1.0f - std::fabs(noise(p, seed + word(i)));
        sum += weight * crest * crest;
        total += weight;
    }
    return sum / total;
}

float tiled_noise(glm::vec2 uv, int frequency, std::uint32_t seed) {
    const glm::vec2 p = uv * static_cast<float>(frequency), cell = glm::floor(p), f = p - cell;
    const int x0 = wrap(static_cast<int>(cell.x), frequency),
              y0 = wrap(static_cast<int>(cell.y), frequency);
    const int x1 = x0 + 1 == frequency ? 0 : x0 + 1, y1 = y0 + 1 == frequency ? 0 : y0 + 1;
    const float u = fade(f.x), v = fade(f.y);
    const auto corner = [&](int x, int y, float dx, float dy) {
        return plane_gradient(hash(word(x), word(y), 7u, seed), dx, dy);
    };
    const float low = glm::mix(corner(x0, y0, f.x, f.y), corner(x1, y0, f.x - 1.0f, f.y), u);
    const float high =
        glm::mix(corner(x0, y1, f.x, f.y - 1.0f), corner(x1, y1, f.x - 1.0f, f.y - 1.0f), u);
    return glm::mix(low, high, v);
}

float tiled_fractal(glm::vec2 uv, int frequency, int octaves, std::uint32_t seed) {
    float sum = 0.0f, weight = 0.5f;
    for (int i = 0; i < octaves; ++i, weight *= 0.5f, frequency *= 2)
        sum += weight * tiled_noise(uv, frequency, seed + word(i));
    return sum * 1.4f;
}

Cell tiled_cells(glm::vec2 uv, int frequency, std::uint32_t seed) {
    const glm::vec2 p = uv * static_cast<float>(frequency), cell = glm::floor(p), f = p - cell;
    const int x = static_cast<int>(cell.x), y = static_cast<int>(cell.y);
    Cell best{8.0f, 8.0f, 0u};
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
            const std::uint32_t id =
                hash(word(wrap(x + i, frequency)), word(wrap(y + j, frequency)), 11u, seed);
            const glm::vec2 point{static_cast<float>(i) + unit_float(id),
                                  static_cast<float>(j) + unit_float(id * 0x9e3779b9u)};
            const float distance = glm::length(point - f);
            if (distance < best.nearest) {
                best.second = best.nearest;
                best.nearest = distance;
                best.id = id;
            } else if (distance < best.second) {
                best.second = distance;
            }
        }
    return best;
}

float smooth_step(float edge0, float edge1, float x) {
    const float t = glm::clamp((x - edge0) / (edge1 - edge0), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

glm::vec2 sin_cos_turns(float turns) {
    float cosine = 0.0f;
    const float sine = shared::m_sin_cos_pi(turns + turns, &cosine);
    return {cosine, sine};
}

} // namespace macula::scene::procedural
