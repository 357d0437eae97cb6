// The two storeys of arcades around the court.
#include <array>
#include <vector>

#include "scenes/procedural/atrium.hpp"

namespace macula::scene::procedural {
namespace {

// A wall over a round arch, symmetric about x = 0.
struct ArchWall {
    float half_width, radius, spring, top, half_depth;
    int segments;
    float moulding; // width of the archivolt
};

glm::vec2 arc_point(const ArchWall& w, int i) {
    const float s = static_cast<float>(i) / static_cast<float>(w.segments);
    return glm::vec2{0.0f, w.spring} + w.radius * sin_cos_turns(0.5f * s);
}

// The face towards +z with its archivolt.
void arch_face(MeshBuilder& b, const ArchWall& w, Finish wall, Finish trim) {
    const float z = w.half_depth;
    b.face({{w.radius, w.spring, z},
            {w.half_width, w.spring, z},
            {w.half_width, w.top, z},
            {w.radius, w.top, z}},
           wall);
    b.face({{-w.half_width, w.spring, z},
            {-w.radius, w.spring, z},
            {-w.radius, w.top, z},
            {-w.half_width, w.top, z}},
           wall);
    for (int i = 0; i < w.segments; ++i) {
        const glm::vec2 right = arc_point(w, i), left = arc_point(w, i + 1);
        b.face({{left, z}, {right, z}, {right.x, w.top, z}, {left.x, w.top, z}}, wall);
    }
    std::vector<Station> stations;
    for (int i = 0; i <= w.segments; ++i) {
        const float s = static_cast<float>(i) / static_cast<float>(w.segments);
        stations.push_back({{arc_point(w, i), z}, {sin_cos_turns(0.5f * s), 0.0f}, {0, 0, 1}});
    }
    const float m = w.moulding;
    const std::array<glm::vec2, 7> section{{{m, -0.01f},
                                            {m, 0.22f * m},
                                            {0.75f * m, 0.26f * m},
                                            {0.68f * m, 0.16f * m},
                                            {0.1f * m, 0.13f * m},
                                            {0.0f, 0.1f * m},
                                            {0.0f, -0.01f}}};
    sweep(b, section, stations, trim);
}

void soffit(MeshBuilder& b, const ArchWall& w, Finish finish) {
    const auto point = [&](float s, float t) {
        return glm::vec3{glm::vec2{0.0f, w.spring} + w.radius * sin_cos_turns(0.5f * s),
                         w.half_depth * (1.0f - 2.0f * t)};
    };
    const auto uv = [&](float s, float t) {
        return glm::vec2{3.1416f * w.radius * s, 2.0f * w.half_depth * t} / finish.tile;
    };
    surface(b, {w.segments, 1}, point, uv, finish.material);
    for (const float x : {-1.0f, 1.0f}) {
        const float lo = x < 0.0f ? -w.half_width : w.radius,
                    hi = x < 0.0f ? -w.radius : w.half_width;
        b.face({{lo, w.spring, -w.half_depth},
                {hi, w.spring, -w.half_depth},
                {hi, w.spring, w.half_depth},
                {lo, w.spring, w.half_depth}},
               finish);
    }
}

void arch(MeshBuilder& b, const ArchWall& w, Finish wall, Finish trim) {
    const Placement at = b.place;
    arch_face(b, w, wall, trim);
    b.place.x = -at.x;
    b.place.z = -at.z;
    arch_face(b, w, wall, trim);
    b.place = at;
    soffit(b, w, trim);
}

void dentils(MeshBuilder& b, float height, float half_bay, float depth, Finish finish) {
    constexpr float kPitch = 0.25f;
    const int count = static_cast<int>(2.0f * half_bay / kPitch);
    for (int i = 0; i < count; ++i) {
        const float x = -half_bay + kPitch * (static_cast<float>(i) + 0.25f);
        box(b, {x, height, depth - 0.02f}, {x + 0.5f * kPitch, height + 0.11f, depth + 0.09f},
            finish, kBack | kTop);
    }
}

void balustrade(MeshBuilder& b, const Palette& p) {
    const Placement at = b.place;
    for (const float side : {-1.0f, 1.0f}) {
        const float lo = side < 0.0f ? -1.78f : 0.22f, hi = side < 0.0f ? -0.22f : 1.78f;
        block(b, {lo, kUpperFloor, -0.13f}, {hi, kUpperFloor + 0.13f, 0.13f}, 0.01f, p.stone);
        block(b, {lo, kUpperFloor + 0.83f, -0.15f}, {hi, kUpperFloor + 0.98f, 0.15f}, 0.02f,
              p.stone);
        constexpr int kCount = 5;
        for (int i = 0; i < kCount; ++i) {
            const float x = glm::mix(lo, hi, (static_cast<float>(i) + 0.5f) / kCount);
            b.place.origin = at.point({x, kUpperFloor + 0.13f, 0.0f});
            baluster(b, p);
        }
        b.place = at;
    }
}

void pedestal_and_column(MeshBuilder& b, const Palette& p) {
    const Placement at = b.place;
    block(b, {-0.22f, kUpperFloor, -0.22f}, {0.22f, kUpperFloor + 0.88f, 0.22f}, 0.012f, p.stone);
    block(b, {-0.25f, kUpperFloor + 0.88f, -0.25f}, {0.25f, kUpperFloor + 1.0f, 0.25f}, 0.02f,
          p.stone);
    b.place.origin = at.point({0.0f, kUpperFloor + 1.0f, 0.0f});
    slender_column(b, p);
    b.place = at;
}

} // namespace

std::vector<Bay> court_bays() {
    std::vector<Bay> bays;
    for (int i = 0; i < 7; ++i) {
        const float x = -kCourtX + kBay * (static_cast<float>(i) + 0.5f);
        bays.push_back({upright({x, 0.0f, -kCourtZ}, 0.0f), 0, i});
        bays.push_back({upright({x, 0.0f, kCourtZ}, 0.5f), 1, i});
    }
    for (int i = 0; i < 3; ++i) {
        const float z = -kCourtZ + kBay * (static_cast<float>(i) + 0.5f);
        bays.push_back({upright({-kCourtX, 0.0f, z}, 0.25f), 2, i});
        bays.push_back({upright({kCourtX, 0.0f, z}, 0.75f), 3, i});
    }
    return bays;
}

std::vector<Placement> court_nodes() {
    std::vector<Placement> nodes;
    for (int i = 1; i < 7; ++i) {
        const float x = -kCourtX + kBay * static_cast<float>(i);
        nodes.push_back(upright({x, 0.0f, -kCourtZ}, 0.0f));
        nodes.push_back(upright({x, 0.0f, kCourtZ}, 0.5f));
    }
    for (const float z : {-0.5f * kBay, 0.5f * kBay}) {
        nodes.push_back(upright({-kCourtX, 0.0f, z}, 0.25f));
        nodes.push_back(upright({kCourtX, 0.0f, z}, 0.75f));
    }
    nodes.push_back(upright({-kCourtX, 0.0f, -kCourtZ}, 0.0f));
    nodes.push_back(upright({kCourtX, 0.0f, -kCourtZ}, 0.0f));
    nodes.push_back(upright({-kCourtX, 0.0f, kCourtZ}, 0.5f));
    nodes.push_back(upright({kCourtX, 0.0f, kCourtZ}, 0.5f));
    return nodes;
}

void court_cornice(MeshBuilder& b, float height, std::span<const glm::vec2> section,
                   Finish finish) {
    const std::array<glm::vec3, 5> corners{{{-kCourtX, height, -kCourtZ},
                                            {kCourtX, height, -kCourtZ},
                                            {kCourtX, height, kCourtZ},
                                            {-kCourtX, height, kCourtZ},
                                            {-kCourtX, height, -kCourtZ}}};
    for (std::size_t i = 0; i < 4; ++i) {
        std::array<Station, 2> ends;
        for (std::size_t k = 0; k < 2; ++k) {
            const glm::vec3 corner = corners[i + k];
            ends[k] = {corner,
                       {corner.x < 0.0f ? 1.0f : -1.0f, 0.0f, corner.z < 0.0f ? 1.0f : -1.0f},
                       {0, 1, 0}};
        }
        // Seen from inside, the sweep goes so that up x right is its direction.
        sweep(b, section, ends, finish);
    }
}

void build_ground_arcade(MeshBuilder& b, const Palette& p) {
    constexpr ArchWall kArch{2.0f, 1.52f, kSpring, 5.6f, 0.35f, 20, 0.3f};
    for (const Bay& bay : court_bays()) {
        b.place = bay.place;
        arch(b, kArch, p.ashlar, p.stone);
        for (const float side : {-1.0f, 1.0f})
            block(b, {-0.15f, 5.12f, side > 0.0f ? 0.3f : -0.47f},
                  {0.15f, 5.6f, side > 0.0f ? 0.47f : -0.3f}, 0.02f, p.stone);
        dentils(b, 5.73f, 2.0f, 0.4f, p.stone);
        // The step down into the court.
        box(b, {-2.0f, kCourtFloor, -0.6f}, {2.0f, 0.0f, 0.7f}, p.stone, kBottom | kBack);
    }
    for (const Placement& node : court_nodes()) {
        b.place = node;
        great_column(b, p);
    }
    b.place = {};
    for (const float x : {-kCourtX, kCourtX})
        for (const float z : {-kCourtZ, kCourtZ})
            box(b, {x - 0.37f, kSpring, z - 0.37f}, {x + 0.37f, 5.6f, z + 0.37f}, p.ashlar, kTop);
    constexpr std::array<glm::vec2, 9> kCornice{{{0.35f, 0.0f},
                                                 {0.4f, 0.02f},
                                                 {0.4f, 0.1f},
                                                 {0.42f, 0.12f},
                                                 {0.42f, 0.24f},
                                                 {0.55f, 0.28f},
                                                 {0.6f, 0.31f},
                                                 {0.6f, 0.4f},
                                                 {0.2f, 0.4f}}};
    court_cornice(b, 5.6f, kCornice, p.stone);
}

void build_upper_arcade(MeshBuilder& b, const Palette& p) {
    constexpr ArchWall kArch{1.0f, 0.76f, kUpperSpring, 10.2f, 0.22f, 14, 0.16f};
    for (const Bay& bay : court_bays()) {
        b.place = bay.place;
        for (const float x : {-1.0f, 1.0f}) {
            b.place.origin = bay.place.point({x, 0.0f, 0.0f});
            arch(b, kArch, p.plaster, p.stone);
        }
        b.place = bay.place;
        pedestal_and_column(b, p);
        balustrade(b, p);
        dentils(b, 10.36f, 2.0f, 0.28f, p.stone);
    }
    for (const Placement& node : court_nodes()) {
        b.place = node;
        pedestal_and_column(b, p);
    }
    b.place = {};
    for (const float x : {-kCourtX, kCourtX})
        for (const float z : {-kCourtZ, kCourtZ})
            box(b, {x - 0.24f, kUpperSpring, z - 0.24f}, {x + 0.24f, 10.2f, z + 0.24f}, p.plaster,
                kTop);
    constexpr std::array<glm::vec2, 9> kCornice{{{0.22f, 0.0f},
                                                 {0.27f, 0.02f},
                                                 {0.27f, 0.14f},
                                                 {0.3f, 0.16f},
                                                 {0.3f, 0.3f},
                                                 {0.42f, 0.34f},
                                                 {0.5f, 0.4f},
                                                 {0.5f, 0.5f},
                                                 {0.0f, 0.5f}}};
    court_cornice(b, 10.2f, kCornice, p.stone);
}

} // namespace macula::scene::procedural
