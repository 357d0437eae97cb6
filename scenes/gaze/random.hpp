// Random numbers of gaze models: hashes of a key, so that any time can be asked for first.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include <glm/glm.hpp>

namespace macula::scene {

// SplitMix64's finaliser over the key's parts.
inline std::uint64_t gaze_hash(std::uint64_t seed, std::uint64_t key, std::uint64_t dimension) {
    std::uint64_t z = seed * 0x9e3779b97f4a7c15u + key * 0xd1342543de82ef95u +
                      dimension * 0x2545f4914f6cdd1du + 0x9e3779b97f4a7c15u;
    for (int round = 0; round < 2; ++round) {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        z ^= z >> 31;
    }
    return z;
}

// In (0, 1).
inline double gaze_uniform(std::uint64_t seed, std::uint64_t key, std::uint64_t dimension) {
    return (static_cast<double>(gaze_hash(seed, key, dimension) >> 11) + 0.5) * 0x1p-53;
}

// Two independent normal numbers of unit variance (Box and Muller).
inline glm::dvec2 gaze_normal(std::uint64_t seed, std::uint64_t key, std::uint64_t dimension) {
    const double r = std::sqrt(-2.0 * std::log(gaze_uniform(seed, key, dimension)));
    const double phi = 2.0 * std::numbers::pi * gaze_uniform(seed, key, dimension + 1);
    return {r * std::cos(phi), r * std::sin(phi)};
}

// `direction` turned by x degrees to its right and y degrees up, small angles.
glm::dvec3 turned(const glm::dvec3& direction, const glm::dvec2& degrees);

} // namespace macula::scene
