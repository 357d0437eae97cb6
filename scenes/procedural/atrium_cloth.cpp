// Curtains in the arcades, banners from the balustrades and canopies over the court.
#include <array>
#include <vector>

#include "scenes/procedural/atrium.hpp"

namespace macula::scene::procedural {
namespace {

// Half a curtain hung from (0, 0, 0) along +x, tied back towards x = 0 and falling freely below.
void tied_curtain(MeshBuilder& b, float width, float drop, float phase, Finish finish) {
    constexpr float kTie = 0.55f, kFolds = 6.0f;
    const auto gather = [](float t) {
        const float near_tie = 1.0f - smooth_step(0.0f, 0.5f, std::abs(t - kTie));
        return t < kTie ? glm::mix(1.0f, 0.22f, smooth_step(0.0f, kTie, t))
                        : 0.22f + 0.2f * (1.0f - near_tie);
    };
    const auto point = [&](float s, float t) {
        const float g = gather(t);
        // Cloth that loses width gains depth.
        const float depth = 0.03f + 0.09f * (1.0f - g);
        const float fold = sin_cos_turns(kFolds * s + phase + 0.15f * t).y;
        const float ripple = sin_cos_turns(2.3f * s + 1.7f * t + phase).x;
        const float swag = 0.12f * s * (1.0f - s) * 4.0f * (1.0f - t) * t;
        return glm::vec3{width * g * s, -drop * t - swag, depth * fold + 0.03f * ripple * t};
    };
    const auto uv = [&](float s, float t) {
        return glm::vec2{1.5f * width * s, -drop * t} / finish.tile;
    };
    // Rows run downwards, so columns run backwards to face +z.
    surface(
        b, {36, 16}, [&](float s, float t) { return point(1.0f - s, t); },
        [&](float s, float t) { return uv(1.0f - s, t); }, finish.material);
    b.face({{-0.02f, -kTie * drop - 0.05f, 0.15f},
            {0.26f * width, -kTie * drop - 0.05f, 0.17f},
            {0.26f * width, -kTie * drop + 0.05f, 0.17f},
            {-0.02f, -kTie * drop + 0.05f, 0.15f}},
           {finish.material, 0.2f});
}

void curtain_pair(MeshBuilder& b, const Palette& p, Finish cloth, Random& random) {
    const Placement at = b.place;
    constexpr float kHalf = 1.5f, kRod = 3.45f, kDepth = -0.5f;
    const std::array<glm::vec3, 2> rod{{{-1.7f, kRod, kDepth}, {1.7f, kRod, kDepth}}};
    tube(b, rod, 0.03f, 8, p.bronze);
    b.place.origin = at.point({-kHalf, kRod - 0.03f, kDepth});
    tied_curtain(b, 1.46f, 3.35f, random.uniform(), cloth);
    b.place.origin = at.point({kHalf, kRod - 0.03f, kDepth});
    b.place.x = -at.x;
    tied_curtain(b, 1.46f, 3.35f, random.uniform(), cloth);
    b.place = at;
}

// A pennant hung before the balustrade, with a pointed end.
void banner(MeshBuilder& b, const Palette& p, float width, float drop, Finish cloth,
            Random& random) {
    const float phase = random.uniform();
    const std::array<glm::vec3, 2> rod{{{-0.6f * width, 0.0f, 0.0f}, {0.6f * width, 0.0f, 0.0f}}};
    tube(b, rod, 0.025f, 8, p.bronze);
    const auto point = [&](float s, float t) {
        const float side = 2.0f * (1.0f - s) - 1.0f;
        const float wave = sin_cos_turns(0.9f * t + 0.35f * side + phase).y;
        const float fall = t * drop * (1.0f - 0.16f * std::abs(side));
        return glm::vec3{0.5f * width * side, -fall, 0.09f * t * wave + 0.02f};
    };
    const auto uv = [&](float s, float t) {
        return glm::vec2{(1.0f - s) * width, -t * drop} / cloth.tile;
    };
    surface(b, {10, 20}, point, uv, cloth.material);
}

// A striped awning slung across the court on two ropes.
void canopy(MeshBuilder& b, const Palette& p, float x, float width, float height, float phase) {
    constexpr float kReach = kCourtZ - 0.75f, kSag = 1.3f;
    const auto point = [&](float s, float t) {
        const float across = 2.0f * t - 1.0f;
        const float sag = kSag * (1.0f - across * across);
        const float belly = 0.35f * 4.0f * s * (1.0f - s) * (1.0f - across * across);
        const float ripple = 0.05f * sin_cos_turns(5.0f * s + 2.0f * across + phase).y;
        return glm::vec3{x + width * (s - 0.5f), height - sag - belly + ripple, kReach * across};
    };
    const auto uv = [&](float s, float t) {
        return glm::vec2{s * width, 2.0f * kReach * t} / p.canopy.tile;
    };
    surface(
        b, {20, 36}, [&](float s, float t) { return point(s, 1.0f - t); },
        [&](float s, float t) { return uv(s, 1.0f - t); }, p.canopy.material);
    for (const float s : {0.0f, 1.0f}) {
        std::vector<glm::vec3> rope{{x + width * (s - 0.5f), height + 0.15f, -kCourtZ + 0.3f}};
        for (int i = 0; i <= 16; ++i)
            rope.push_back(point(s, static_cast<float>(i) / 16.0f) + glm::vec3{0.0f, 0.01f, 0.0f});
        rope.emplace_back(x + width * (s - 0.5f), height + 0.15f, kCourtZ - 0.3f);
        tube(b, rope, 0.02f, 5, p.bark);
    }
}

} // namespace

void build_cloth(MeshBuilder& b, const Palette& p, Random random) {
    for (const Bay& bay : court_bays()) {
        const bool hung = bay.side < 2 ? bay.index % 2 == 0 : bay.index != 1;
        if (!hung)
            continue;
        b.place = bay.place;
        const int colour = (bay.index / 2 + bay.side) % 3;
        curtain_pair(b, p, p.cloth[colour], random);
    }
    const std::vector<Placement> nodes = court_nodes();
    for (std::size_t i = 0; i < 12; ++i) {
        if (i / 2 % 2 != 0)
            continue;
        b.place = nodes[i];
        b.place.origin = nodes[i].point({0.0f, kUpperFloor + 0.9f, 0.72f});
        banner(b, p, 1.15f, 3.0f, p.cloth[(i / 2 + 1) % 3], random);
    }
    b.place = {};
    canopy(b, p, -6.0f, 4.0f, 9.8f, random.uniform());
    canopy(b, p, 6.0f, 4.0f, 9.9f, random.uniform());
}

} // namespace macula::scene::procedural
