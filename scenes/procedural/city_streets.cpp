// Roadways, pavements and what stands on them.
#include <array>
#include <cmath>
#include <vector>

#include "scenes/procedural/city.hpp"

namespace macula::scene::procedural {
namespace {

constexpr float kPaint = 0.012f; // markings lie this much above the asphalt

void patch(MeshBuilder& b, glm::vec2 lo, glm::vec2 hi, float y, Finish finish) {
    b.face({{lo.x, y, hi.y}, {hi.x, y, hi.y}, {hi.x, y, lo.y}, {lo.x, y, lo.y}}, finish);
}

// Stripes in the frame of a street: local x across it, z along it from 0 to length.
void markings(MeshBuilder& b, const CityPalette& p, float length) {
    const auto stripe = [&](float x, float half, float z0, float z1) {
        b.face({{x - half, kPaint, z1},
                {x + half, kPaint, z1},
                {x + half, kPaint, z0},
                {x - half, kPaint, z0}},
               p.marking);
    };
    const int dashes = static_cast<int>((length - 19.0f) / 6.0f) + 1;
    for (int i = 0; i < dashes; ++i) {
        const float z = 8.0f + 6.0f * static_cast<float>(i);
        stripe(0.0f, 0.08f, z, z + 3.0f);
    }
    for (const float z : {1.2f, length - 4.2f})
        for (int i = 0; i < 12; ++i)
            stripe(1.1f * (static_cast<float>(i) - 5.5f), 0.28f, z, z + 3.0f);
    for (const float side : {-1.0f, 1.0f})
        stripe(side * (0.5f * kStreet - 2.4f), 0.05f, 8.0f, length - 8.0f);
}

// A post with an arm over the kerb, which lies towards local +z.
void street_lamp(MeshBuilder& b, const CityPalette& p) {
    constexpr std::array<glm::vec2, 6> kPost{{{0.16f, 0.0f},
                                              {0.16f, 0.3f},
                                              {0.09f, 0.5f},
                                              {0.07f, 3.0f},
                                              {0.055f, 7.2f},
                                              {0.0f, 7.25f}}};
    revolve(b, kPost, {7, 0.0f, 1.0f, {}}, p.dark_metal);
    const std::array<glm::vec3, 4> arm{
        {{0, 7.0f, 0}, {0, 7.45f, 0.35f}, {0, 7.6f, 0.9f}, {0, 7.6f, 1.5f}}};
    tube(b, arm, 0.04f, 5, p.dark_metal);
    box(b, {-0.14f, 7.52f, 1.1f}, {0.14f, 7.66f, 1.8f}, p.dark_metal, kBottom);
    b.face({{-0.12f, 7.52f, 1.12f},
            {0.12f, 7.52f, 1.12f},
            {0.12f, 7.52f, 1.78f},
            {-0.12f, 7.52f, 1.78f}},
           {p.lamp, 1.0f});
}

void bench(MeshBuilder& b, const CityPalette& p) {
    for (int i = 0; i < 3; ++i) {
        const float z = -0.24f + 0.17f * static_cast<float>(i);
        box(b, {-0.9f, 0.44f, z}, {0.9f, 0.48f, z + 0.13f}, p.wood);
    }
    box(b, {-0.9f, 0.62f, -0.3f}, {0.9f, 0.86f, -0.26f}, p.wood);
    for (const float x : {-0.7f, 0.7f})
        box(b, {x - 0.03f, 0.0f, -0.28f}, {x + 0.03f, 0.62f, -0.22f}, p.dark_metal, kTop | kBottom);
}

void hydrant(MeshBuilder& b, const CityPalette& p) {
    constexpr std::array<glm::vec2, 7> kBody{{{0.16f, 0.0f},
                                              {0.16f, 0.06f},
                                              {0.11f, 0.08f},
                                              {0.11f, 0.5f},
                                              {0.15f, 0.53f},
                                              {0.11f, 0.66f},
                                              {0.0f, 0.74f}}};
    revolve(b, kBody, {9, 0.0f, 1.0f, {}}, {p.sign[0], 1.0f});
}

// Furniture along one side of a block: local x along the kerb, +z to the street.
void furnish(MeshBuilder& b, const CityPalette& p, float length, Random& random) {
    const Placement at = b.place;
    const auto put = [&](float x, float z, float turns) {
        b.place = at;
        const glm::vec2 cs = sin_cos_turns(turns);
        b.place.origin = at.point({x, kKerb, z});
        b.place.x = at.x * cs.x - at.z * cs.y;
        b.place.z = at.x * cs.y + at.z * cs.x;
    };
    const int slots = static_cast<int>((length - 10.0f) / 7.5f) + 1;
    for (int slot = 0; slot < slots; ++slot) {
        const float x = 6.0f + 7.5f * static_cast<float>(slot);
        if (slot % 3 == 0) {
            put(x, -0.6f, 0.0f);
            street_lamp(b, p);
        } else {
            const float turns = random.uniform(), height = random.range(5.5f, 8.5f);
            put(x, -1.0f, turns);
            street_tree(b, p, height, random);
        }
        if (slot % 4 == 2) {
            put(x + 3.0f, -0.8f, 0.0f);
            bench(b, p);
        }
    }
    put(4.0f, -0.5f, 0.0f);
    hydrant(b, p);
    b.place = at;
}

glm::vec3 random_direction(Random& random) {
    const float turn = random.uniform(), y = random.symmetric(1.0f);
    const glm::vec2 cs = sin_cos_turns(turn);
    const float r = std::sqrt(std::max(0.0f, 1.0f - y * y));
    return {r * cs.x, y, r * cs.y};
}

} // namespace

float street_x(int i) {
    return kPitchX * (static_cast<float>(i) - 0.5f * kBlocksX);
}
float street_z(int i) {
    return kPitchZ * (static_cast<float>(i) - 0.5f * kBlocksZ);
}

void street_tree(MeshBuilder& b, const CityPalette& p, float height, Random& random) {
    std::vector<glm::vec3> trunk{{0, 0, 0}};
    for (int i = 1; i <= 3; ++i) {
        const float x = random.symmetric(0.12f), z = random.symmetric(0.12f);
        trunk.emplace_back(x, 0.2f * height * static_cast<float>(i), z);
    }
    tube(b, trunk, 0.022f * height, 6, p.bark);
    const std::uint32_t leaves = p.leaves[random.chance(0.3f) ? 1 : 0];
    const glm::vec3 centre{0.0f, 0.66f * height, 0.0f};
    const glm::vec3 radii{0.26f * height, 0.33f * height, 0.26f * height};
    const int count = static_cast<int>(11.0f * height);
    for (int i = 0; i < count; ++i) {
        const glm::vec3 out = random_direction(random), wild = random_direction(random);
        const float depth = 1.0f - 0.8f * random.uniform() * random.uniform();
        const float size = 0.16f * height * random.range(0.8f, 1.3f);
        const glm::vec3 up = glm::normalize(0.7f * out + 0.9f * wild + glm::vec3{0.0f, 0.4f, 0.0f});
        const glm::vec3 side = along({0, 0, 0}, up).x * (0.5f * size);
        const glm::vec3 stem = centre + out * radii * depth * 0.7f;
        const std::array<glm::vec3, 4> corners{stem - side, stem + side, stem + side + up * size,
                                               stem - side + up * size};
        const std::array<glm::vec2, 4> uvs{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
        b.card(corners, uvs, leaves);
    }
}

void build_streets(MeshBuilder& b, const CityPalette& p, Random random) {
    const float edge = 0.5f * kStreet;
    patch(b, {street_x(0) - edge, street_z(0) - edge},
          {street_x(kBlocksX) + edge, street_z(kBlocksZ) + edge}, 0.0f, p.asphalt);
    for (int j = 0; j < kBlocksZ; ++j)
        for (int i = 0; i < kBlocksX; ++i) {
            const glm::vec3 lo{street_x(i) + edge, 0.0f, street_z(j) + edge};
            const glm::vec3 hi{lo.x + kBlockX, kKerb, lo.z + kBlockZ};
            b.place = {};
            box(b, lo, hi, p.pavement, kBottom);
            b.place = {{lo.x, 0, hi.z}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1.0f};
            furnish(b, p, kBlockX, random);
            b.place = {{hi.x, 0, lo.z}, {-1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 1.0f};
            furnish(b, p, kBlockX, random);
            b.place = {{hi.x, 0, hi.z}, {0, 0, -1}, {0, 1, 0}, {1, 0, 0}, 1.0f};
            furnish(b, p, kBlockZ, random);
            b.place = {{lo.x, 0, lo.z}, {0, 0, 1}, {0, 1, 0}, {-1, 0, 0}, 1.0f};
            furnish(b, p, kBlockZ, random);
        }
    for (int j = 0; j < kBlocksZ; ++j)
        for (int i = 0; i <= kBlocksX; ++i) {
            b.place = upright({street_x(i), 0.0f, street_z(j) + edge});
            markings(b, p, kBlockZ);
        }
    for (int j = 0; j <= kBlocksZ; ++j)
        for (int i = 0; i < kBlocksX; ++i) {
            b.place = upright({street_x(i) + edge, 0.0f, street_z(j)}, 0.25f);
            markings(b, p, kBlockX);
        }
    b.place = {};
}

} // namespace macula::scene::procedural
