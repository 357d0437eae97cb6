// Counter-based random numbers and coherent noise: pure functions of their arguments, made of
// integer hashes and basic arithmetic, so that scenes are equal on every platform.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace macula::scene::procedural {

// 32 well-mixed bits from four words.
std::uint32_t hash(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t seed);

// A uniform float in [0, 1) from 32 random bits.
inline float unit_float(std::uint32_t bits) {
    return static_cast<float>(bits >> 8) * 0x1p-24f;
}

// The n-th draw is a hash of (seed, stream, n). Draw in statements or braces, never in the
// arguments of one call: their order of evaluation is the compiler's choice.
class Random {
  public:
    Random(std::uint64_t seed, std::uint32_t stream);
    std::uint32_t bits();
    float uniform() { return unit_float(bits()); } // [0, 1)
    float range(float lo, float hi) { return lo + (hi - lo) * uniform(); }
    float symmetric(float size) { return range(-size, size); }
    std::uint32_t below(std::uint32_t count); // 0..count-1, count >= 1
    int between(int lo, int hi);              // lo..hi, both included
    bool chance(float probability) { return uniform() < probability; }

  private:
    std::uint32_t key_;
    std::uint32_t stream_;
    std::uint32_t counter_ = 0;
};

// The low word of a 64-bit seed folded with its high one, for the functions below.
std::uint32_t fold_seed(std::uint64_t seed);

// Gradient noise in about [-1, 1], zero at integer points.
float noise(glm::vec3 p, std::uint32_t seed);
// Sum of `octaves` noises of doubling frequency and halving weight, about [-1, 1].
float fractal_noise(glm::vec3 p, int octaves, std::uint32_t seed);
// 1 - |noise| summed likewise, in [0, 1]: sharp crests.
float ridged_noise(glm::vec3 p, int octaves, std::uint32_t seed);

// Noise for textures, periodic in u and v with period 1 at `frequency` cells a period.
float tiled_noise(glm::vec2 uv, int frequency, std::uint32_t seed);
float tiled_fractal(glm::vec2 uv, int frequency, int octaves, std::uint32_t seed);

// Periodic cellular noise (Worley 1996).
struct Cell {
    float nearest, second; // distances to the two nearest points, in cells
    std::uint32_t id;      // hash of the nearest point's cell
};
Cell tiled_cells(glm::vec2 uv, int frequency, std::uint32_t seed);

// 3 t^2 - 2 t^3 between the edges, clamped outside.
float smooth_step(float edge0, float edge1, float x);

// sin and cos of `turns` full turns, the same bits everywhere.
glm::vec2 sin_cos_turns(float turns); // x = cos, y = sin

} // namespace macula::scene::procedural
