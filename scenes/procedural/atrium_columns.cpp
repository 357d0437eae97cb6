// The turned and carved pieces: columns, balusters, pots, the fountain, lanterns, the rosette.
#include <array>
#include <cmath>
#include <vector>

#include "scenes/procedural/atrium.hpp"

namespace macula::scene::procedural {
namespace {

// A moulding of circular section from (r0, y0) to (r1, y1), bulging by `out`.
void add_torus(std::vector<glm::vec2>& profile, glm::vec2 from, glm::vec2 to, float out,
               int steps) {
    for (int i = 0; i <= steps; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(steps);
        const float bulge = out * sin_cos_turns(0.5f * t).y;
        profile.push_back(glm::mix(from, to, t) + glm::vec2{bulge, 0.0f});
    }
}

void add_attic_base(std::vector<glm::vec2>& profile, float radius, float y, float height) {
    add_torus(profile, {radius * 1.25f, y}, {radius * 1.25f, y + 0.4f * height}, radius * 0.15f, 5);
    profile.emplace_back(radius * 1.2f, y + 0.42f * height);
    add_torus(profile, {radius * 1.15f, y + 0.45f * height}, {radius * 1.12f, y + 0.65f * height},
              -radius * 0.06f, 3);
    add_torus(profile, {radius * 1.12f, y + 0.68f * height}, {radius * 1.06f, y + height},
              radius * 0.1f, 4);
}

// A carved leaf standing against the bell of a capital, curling over at its tip.
void capital_leaf(MeshBuilder& b, glm::ivec2 cells, float turn, float radius, float y, float height,
                  float width, Finish finish) {
    const auto point = [&](float s, float t) {
        const float side = 2.0f * s - 1.0f;
        const float curl = t * t;
        const float taper =
            (1.0f - 0.55f * t * t) * (1.0f - 0.12f * std::fabs(sin_cos_turns(1.5f * t).y));
        const float out = radius + 0.02f + 0.10f * curl * height / 0.3f - 0.03f * side * side;
        const float rise = y + height * (t - 0.25f * t * t * t);
        const glm::vec2 cs = sin_cos_turns(turn + side * width * taper / (6.2831853f * radius));
        return glm::vec3{out * cs.x, rise, -out * cs.y};
    };
    const auto uv = [&](float s, float t) {
        return glm::vec2{s * width, t * height} / finish.tile;
    };
    surface(b, cells, point, uv, finish.material);
}

// The spiral under a corner of the abacus.
void volute(MeshBuilder& b, float turn, float radius, float y, Finish finish) {
    std::vector<glm::vec3> line;
    const glm::vec2 out = sin_cos_turns(turn);
    for (int i = 0; i <= 10; ++i) {
        const float t = static_cast<float>(i) / 10.0f;
        const glm::vec2 spiral = sin_cos_turns(0.25f + 1.4f * t) * (0.11f * (1.0f - 0.75f * t));
        const float reach = radius + 0.02f + spiral.x;
        line.emplace_back(reach * out.x, y + spiral.y, -reach * out.y);
    }
    tube(b, line, 0.028f, 5, finish);
}

} // namespace

void great_column(MeshBuilder& b, const Palette& p) {
    block(b, {-0.5f, 0.0f, -0.5f}, {0.5f, 0.22f, 0.5f}, 0.02f, p.stone);
    std::vector<glm::vec2> base;
    add_attic_base(base, 0.36f, 0.22f, 0.3f);
    revolve(b, base, {24, 0.0f, 1.0f, {}}, p.stone);

    // Twenty flutes with sharp arrises; entasis by the profile.
    constexpr std::array<glm::vec2, 4> kShaft{
        {{0.36f, 0.52f}, {0.352f, 1.3f}, {0.333f, 2.2f}, {0.31f, 2.95f}}};
    const auto flute = [](float turn, float) {
        const float phase = turn * 20.0f - std::floor(turn * 20.0f);
        return 1.0f - 0.085f * sin_cos_turns(0.5f * phase).y;
    };
    revolve(b, kShaft, {80, 0.0f, 1.0f, flute}, p.stone);

    std::vector<glm::vec2> neck;
    add_torus(neck, {0.31f, 2.95f}, {0.31f, 3.02f}, 0.04f, 4);
    for (int i = 0; i <= 5; ++i) {
        const float t = static_cast<float>(i) / 5.0f;
        neck.emplace_back(0.30f + 0.16f * t * t * t, 3.02f + 0.52f * t);
    }
    revolve(b, neck, {24, 0.0f, 1.0f, {}}, p.stone);
    for (int i = 0; i < 8; ++i) {
        const float turn = static_cast<float>(i) / 8.0f;
        capital_leaf(b, {4, 4}, turn, 0.31f, 3.02f, 0.27f, 0.24f, p.stone);
        capital_leaf(b, {4, 4}, turn + 0.0625f, 0.33f, 3.12f, 0.36f, 0.22f, p.stone);
    }
    for (int i = 0; i < 4; ++i)
        volute(b, 0.125f + 0.25f * static_cast<float>(i), 0.44f, 3.43f, p.stone);
    block(b, {-0.48f, 3.54f, -0.48f}, {0.48f, kSpring, 0.48f}, 0.025f, p.stone);
}

void slender_column(MeshBuilder& b, const Palette& p) {
    block(b, {-0.22f, 0.0f, -0.22f}, {0.22f, 0.08f, 0.22f}, 0.012f, p.stone);
    std::vector<glm::vec2> profile;
    add_attic_base(profile, 0.15f, 0.08f, 0.12f);
    profile.emplace_back(0.15f, 0.21f);
    profile.emplace_back(0.148f, 0.8f);
    profile.emplace_back(0.135f, 1.4f);
    add_torus(profile, {0.135f, 1.42f}, {0.135f, 1.47f}, 0.03f, 3);
    profile.emplace_back(0.135f, 1.5f);
    profile.emplace_back(0.16f, 1.66f);
    profile.emplace_back(0.21f, 1.76f);
    revolve(b, profile, {12, 0.0f, 1.0f, {}}, p.stone);
    for (int i = 0; i < 6; ++i)
        capital_leaf(b, {2, 3}, static_cast<float>(i) / 6.0f, 0.14f, 1.5f, 0.2f, 0.13f, p.stone);
    block(b, {-0.24f, 1.76f, -0.24f}, {0.24f, 1.9f, 0.24f}, 0.015f, p.stone);
}

void baluster(MeshBuilder& b, const Palette& p) {
    constexpr std::array<glm::vec2, 8> kProfile{{{0.075f, 0.0f},
                                                 {0.075f, 0.05f},
                                                 {0.075f, 0.18f},
                                                 {0.085f, 0.26f},
                                                 {0.06f, 0.4f},
                                                 {0.035f, 0.54f},
                                                 {0.06f, 0.6f},
                                                 {0.075f, 0.7f}}};
    revolve(b, kProfile, {8, 0.0f, 1.0f, {}}, p.stone);
}

void flower_pot(MeshBuilder& b, const Palette& p, float radius, float height) {
    std::vector<glm::vec2> profile{{0.0f, 0.0f},  {0.62f, 0.0f}, {0.66f, 0.06f}, {0.86f, 0.5f},
                                   {0.92f, 0.8f}, {1.0f, 0.82f}, {1.04f, 0.91f}, {1.0f, 1.0f},
                                   {0.88f, 1.0f}, {0.86f, 0.9f}};
    for (glm::vec2& point : profile)
        point = {point.x * radius, point.y * height};
    revolve(b, profile, {20, 0.0f, 1.0f, {}}, p.clay);
    const std::array<glm::vec2, 2> earth{
        {{0.87f * radius, 0.92f * height}, {0.0f, 0.95f * height}}};
    revolve(b, earth, {20, 0.0f, 1.0f, {}}, p.soil);
}

void fountain(MeshBuilder& b, const Palette& p) {
    constexpr std::array<glm::vec2, 11> kBasin{{{2.25f, 0.0f},
                                                {2.25f, 0.12f},
                                                {2.05f, 0.14f},
                                                {2.02f, 0.2f},
                                                {1.98f, 0.42f},
                                                {2.1f, 0.48f},
                                                {2.16f, 0.56f},
                                                {2.1f, 0.64f},
                                                {1.82f, 0.64f},
                                                {1.8f, 0.6f},
                                                {1.74f, 0.2f}}};
    const auto octagon = [](float turn, float) {
        const float phase = turn * 8.0f - std::floor(turn * 8.0f) - 0.5f;
        return 0.924f / sin_cos_turns(phase / 8.0f).x;
    };
    revolve(b, kBasin, {64, 0.0f, 1.0f, octagon}, p.stone);
    const std::array<glm::vec2, 2> pool{{{1.8f, 0.46f}, {0.0f, 0.46f}}};
    revolve(b, pool, {48, 0.0f, 1.0f, {}}, p.water);
    std::vector<glm::vec2> shaft{{0.4f, 0.2f}, {0.4f, 0.5f}};
    add_attic_base(shaft, 0.24f, 0.5f, 0.25f);
    for (const glm::vec2 point : {glm::vec2{0.16f, 1.0f},
                                  {0.14f, 1.25f},
                                  {0.2f, 1.4f},
                                  {0.45f, 1.5f},
                                  {0.85f, 1.66f},
                                  {0.98f, 1.82f},
                                  {0.98f, 1.88f},
                                  {0.9f, 1.88f},
                                  {0.8f, 1.74f}})
        shaft.push_back(point);
    revolve(b, shaft, {40, 0.0f, 1.0f, {}}, p.stone);
    const std::array<glm::vec2, 2> bowl{{{0.88f, 1.82f}, {0.0f, 1.82f}}};
    revolve(b, bowl, {32, 0.0f, 1.0f, {}}, p.water);
    std::vector<glm::vec2> finial{{0.16f, 1.7f}, {0.12f, 1.9f}, {0.1f, 2.05f}};
    add_torus(finial, {0.1f, 2.05f}, {0.04f, 2.3f}, 0.1f, 8);
    finial.emplace_back(0.0f, 2.42f);
    revolve(b, finial, {24, 0.0f, 1.0f, {}}, p.bronze);
}

void lantern(MeshBuilder& b, const Palette& p, float chain_length) {
    hanging_chain(b, p, chain_length);
    const Placement at = b.place;
    b.place.origin = at.point({0.0f, -chain_length - 0.62f, 0.0f});
    constexpr std::array<glm::vec2, 7> kCap{{{0.21f, 0.46f},
                                             {0.24f, 0.46f},
                                             {0.22f, 0.5f},
                                             {0.12f, 0.54f},
                                             {0.06f, 0.58f},
                                             {0.03f, 0.62f},
                                             {0.0f, 0.63f}}};
    constexpr std::array<glm::vec2, 6> kFoot{{{0.0f, -0.08f},
                                              {0.05f, -0.04f},
                                              {0.16f, 0.0f},
                                              {0.2f, 0.03f},
                                              {0.2f, 0.06f},
                                              {0.0f, 0.06f}}};
    revolve(b, kCap, {6, 0.0f, 1.0f, {}}, p.bronze);
    revolve(b, kFoot, {6, 0.0f, 1.0f, {}}, p.bronze);
    for (int i = 0; i < 6; ++i) {
        const glm::vec2 cs = 0.19f * sin_cos_turns(static_cast<float>(i) / 6.0f);
        const std::array<glm::vec3, 2> bar{
            {{cs.x, 0.05f, -cs.y}, {1.08f * cs.x, 0.47f, -1.08f * cs.y}}};
        tube(b, bar, 0.014f, 4, p.bronze);
    }
    sphere(b, {0.0f, 0.22f, 0.0f}, 0.09f, {12, 8}, {p.flame, 1.0f});
    b.place = at;
}

void rosette(MeshBuilder& b, const Palette& p, float radius) {
    const auto point = [&](float s, float t) {
        // A relief of two rings of petals around a boss.
        const glm::vec2 cs = sin_cos_turns(s);
        const float petals = std::fabs(sin_cos_turns(4.0f * s).x);
        const float inner = smooth_step(0.25f, 0.45f, t) * (1.0f - smooth_step(0.5f, 0.62f, t));
        const float outer = smooth_step(0.6f, 0.75f, t) * (1.0f - smooth_step(0.82f, 0.93f, t));
        const float boss = 1.0f - smooth_step(0.0f, 0.26f, t);
        const float rim = smooth_step(0.93f, 0.95f, t) * (1.0f - smooth_step(0.97f, 1.0f, t));
        const float height =
            0.16f * boss + 0.12f * inner * petals + 0.14f * outer * (1.0f - petals) + 0.12f * rim;
        return glm::vec3{radius * t * cs.x, radius * t * cs.y, 0.05f + radius * height};
    };
    const auto uv = [&](float s, float t) {
        return sin_cos_turns(s) * (t * radius / p.stone.tile);
    };
    // (s, t) turns anticlockwise and outwards, so it is mirrored to face +z.
    surface(
        b, {64, 22}, [&](float s, float t) { return point(1.0f - s, t); },
        [&](float s, float t) { return uv(1.0f - s, t); }, p.stone.material);
}

} // namespace macula::scene::procedural
