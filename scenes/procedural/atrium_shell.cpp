// Floors, outer walls, vaults and doors: what encloses the galleries.
#include <array>
#include <cmath>
#include <vector>

#include "scenes/procedural/atrium.hpp"

namespace macula::scene::procedural {
namespace {

constexpr float kWallX = kCourtX + kGallery, kWallZ = kCourtZ + kGallery;

// A trapezoid on each side of the court, between two distances outwards from the arcades.
void ring(MeshBuilder& b, float inner, float outer, float y, bool facing_up, Finish finish) {
    for (int side = 0; side < 4; ++side) {
        const auto corner = [&](float out, float sign) {
            const float x = kCourtX + out, z = kCourtZ + out;
            switch (side) {
            case 0:
                return glm::vec3{sign * x, y, -z};
            case 1:
                return glm::vec3{x, y, sign * z};
            case 2:
                return glm::vec3{-sign * x, y, z};
            default:
                return glm::vec3{-x, y, -sign * z};
            }
        };
        std::array<glm::vec3, 4> c{corner(inner, -1.0f), corner(inner, 1.0f), corner(outer, 1.0f),
                                   corner(outer, -1.0f)};
        if (!facing_up)
            std::swap(c[1], c[3]);
        b.face(c, finish);
    }
}

// The four outer walls seen from inside, in the planes `inset` from them.
void walls(MeshBuilder& b, float y0, float y1, float inset, Finish finish) {
    const float x = kWallX - inset, z = kWallZ - inset;
    b.face({{-x, y0, -z}, {x, y0, -z}, {x, y1, -z}, {-x, y1, -z}}, finish);
    b.face({{x, y0, z}, {-x, y0, z}, {-x, y1, z}, {x, y1, z}}, finish);
    b.face({{-x, y0, z}, {-x, y0, -z}, {-x, y1, -z}, {-x, y1, z}}, finish);
    b.face({{x, y0, -z}, {x, y0, z}, {x, y1, z}, {x, y1, -z}}, finish);
    if (inset > 0.0f)
        ring(b, kGallery - inset, kGallery, y1, true, finish);
}

// A groin vault over half sizes x, z: where two barrel vaults meet.
void groin_vault(MeshBuilder& b, glm::vec2 half, Finish finish) {
    for (int web = 0; web < 4; ++web) {
        const float sign = web % 2 == 0 ? 1.0f : -1.0f;
        const bool along_x = web < 2;
        const auto point = [&](float s, float t) {
            const float reach = sign * t, side = (2.0f * s - 1.0f) * reach;
            const float x = along_x ? reach : side, z = along_x ? -side : reach;
            const float rise = std::sqrt(std::max(0.0f, 1.0f - side * side));
            return glm::vec3{half.x * x, kSpring + kVaultRise * rise, half.y * z};
        };
        const auto uv = [&](float s, float t) {
            const glm::vec3 at = b.place.point(point(s, t));
            return glm::vec2{at.x, at.z} / finish.tile;
        };
        surface(b, {12, 5}, point, uv, finish.material);
    }
}

// An arch across a gallery, from z = 0 to z = -kGallery.
void transverse_rib(MeshBuilder& b, Finish finish) {
    constexpr int kSteps = 16;
    std::vector<Station> stations;
    for (int i = 0; i <= kSteps; ++i) {
        const glm::vec2 cs = sin_cos_turns(0.5f * static_cast<float>(i) / kSteps);
        const glm::vec3 at{0.0f, kSpring + (kVaultRise - 0.02f) * cs.y,
                           0.5f * kGallery * (cs.x - 1.0f)};
        const glm::vec3 out =
            glm::normalize(glm::vec3{0.0f, cs.y / kVaultRise, cs.x / (0.5f * kGallery)});
        stations.push_back({at, {1, 0, 0}, out});
    }
    constexpr std::array<glm::vec2, 6> kSection{{{-0.26f, 0.05f},
                                                 {-0.26f, -0.1f},
                                                 {-0.2f, -0.14f},
                                                 {0.2f, -0.14f},
                                                 {0.26f, -0.1f},
                                                 {0.26f, 0.05f}}};
    sweep(b, kSection, stations, finish);
}

void pilaster(MeshBuilder& b, float bottom, float top, Finish finish) {
    block(b, {-0.3f, bottom, -0.02f}, {0.3f, bottom + 0.3f, 0.24f}, 0.02f, finish);
    box(b, {-0.25f, bottom + 0.3f, 0.0f}, {0.25f, top - 0.2f, 0.2f}, finish,
        kBack | kTop | kBottom);
    block(b, {-0.3f, top - 0.22f, -0.02f}, {0.3f, top, 0.25f}, 0.03f, finish);
}

// An arched door or shutter before a wall, `half` wide to each side.
void door(MeshBuilder& b, const Palette& p, float half, float bottom, float spring) {
    constexpr int kSteps = 10;
    std::vector<Station> stations{{{half, bottom, 0.0f}, {1, 0, 0}, {0, 0, 1}}};
    std::vector<glm::vec3> panel{{-half, bottom, 0.05f}, {half, bottom, 0.05f}};
    for (int i = 0; i <= kSteps; ++i) {
        const glm::vec2 cs = sin_cos_turns(0.5f * static_cast<float>(i) / kSteps);
        const glm::vec2 at = glm::vec2{0.0f, spring} + half * cs;
        stations.push_back({{at, 0.0f}, {cs, 0.0f}, {0, 0, 1}});
        panel.emplace_back(at, 0.05f);
    }
    stations.push_back({{-half, bottom, 0.0f}, {-1, 0, 0}, {0, 0, 1}});
    constexpr std::array<glm::vec2, 6> kFrame{{{0.22f, 0.0f},
                                               {0.22f, 0.12f},
                                               {0.14f, 0.16f},
                                               {0.04f, 0.14f},
                                               {0.0f, 0.1f},
                                               {0.0f, 0.0f}}};
    sweep(b, kFrame, stations, p.stone);
    b.face(panel, p.wood);
    box(b, {-0.025f, bottom, 0.04f}, {0.025f, spring + half, 0.08f}, p.wood, kBack);
    for (int i = 0; i < 3; ++i) {
        const float y = glm::mix(bottom, spring, 0.15f + 0.35f * static_cast<float>(i));
        box(b, {-half, y, 0.04f}, {half, y + 0.06f, 0.075f}, p.bronze, kBack);
    }
}

void outer_walls(MeshBuilder& b, const Palette& p) {
    walls(b, 0.0f, kUpperFloor, 0.0f, p.plaster);
    walls(b, kUpperFloor, kRidge, 0.0f, p.plaster);
    walls(b, 0.0f, 1.0f, 0.06f, p.ashlar);
    walls(b, kUpperFloor, kUpperFloor + 0.7f, 0.05f, p.stone);
    for (const Placement& node : court_nodes()) {
        b.place = node;
        b.place.origin = node.point({0.0f, 0.0f, -kGallery});
        pilaster(b, 0.0f, kSpring, p.stone);
        pilaster(b, kUpperFloor, kEaves, p.stone);
    }
    for (const float x : {-kCourtX, kCourtX})
        for (const float z : {-kCourtZ, kCourtZ}) {
            b.place = upright({x < 0.0f ? -kWallX : kWallX, 0.0f, z}, x < 0.0f ? 0.25f : 0.75f);
            pilaster(b, 0.0f, kSpring, p.stone);
            pilaster(b, kUpperFloor, kEaves, p.stone);
        }
    for (const Bay& bay : court_bays()) {
        b.place = bay.place;
        b.place.origin = bay.place.point({0.0f, 0.0f, -kGallery + 0.06f});
        if (bay.side < 2 && bay.index % 2 == 1)
            door(b, p, 0.75f, 0.0f, 2.3f);
        door(b, p, 0.55f, kUpperFloor + (bay.index % 2 == 0 ? 0.9f : 0.0f), kUpperFloor + 2.2f);
        if (bay.side >= 2 && bay.index == 1) {
            b.place.origin = bay.place.point({0.0f, 2.7f, -kGallery});
            rosette(b, p, 1.0f);
        }
    }
    b.place = {};
}

void vaults(MeshBuilder& b, const Palette& p) {
    for (const Bay& bay : court_bays()) {
        b.place = bay.place;
        b.place.origin = bay.place.point({0.0f, 0.0f, -0.5f * kGallery});
        groin_vault(b, {0.5f * kBay, 0.5f * kGallery}, p.vault);
    }
    b.place = {};
    for (const float x : {-1.0f, 1.0f})
        for (const float z : {-1.0f, 1.0f}) {
            b.place.origin = {x * (kCourtX + 0.5f * kGallery), 0.0f,
                              z * (kCourtZ + 0.5f * kGallery)};
            groin_vault(b, glm::vec2{0.5f * kGallery}, p.vault);
        }
    for (const Placement& node : court_nodes()) {
        b.place = node;
        transverse_rib(b, p.stone);
    }
    for (const float x : {-kCourtX, kCourtX})
        for (const float z : {-kCourtZ, kCourtZ}) {
            b.place = upright({x, 0.0f, z}, x < 0.0f ? 0.25f : 0.75f);
            transverse_rib(b, p.stone);
        }
    b.place = {};
}

} // namespace

void build_shell(MeshBuilder& b, const Palette& p) {
    const float x = kCourtX - 0.7f, z = kCourtZ - 0.7f;
    b.face({{-x, kCourtFloor, z}, {x, kCourtFloor, z}, {x, kCourtFloor, -z}, {-x, kCourtFloor, -z}},
           p.floor);
    ring(b, 0.6f, kGallery, 0.0f, true, p.slabs);
    ring(b, -0.2f, kGallery, kUpperFloor, true, p.slabs);
    outer_walls(b, p);
    vaults(b, p);
}

} // namespace macula::scene::procedural
