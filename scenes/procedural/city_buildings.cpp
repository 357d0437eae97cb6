// Buildings: tiers of walls with roofs and what stands on them; parks.
#include <algorithm>
#include <array>
#include <cmath>

#include "scenes/procedural/city.hpp"

namespace macula::scene::procedural {
namespace {

enum class Style { walk_up, apartments, office, glass_tower, setback_tower };

struct Design {
    Style style;
    Finish wall;
    float storey;
};

std::array<Placement, 4> side_frames(const Plot& plot) {
    const glm::vec3 y{0, 1, 0};
    return {{{{plot.lo.x, 0, plot.hi.y}, {1, 0, 0}, y, {0, 0, 1}},
             {{plot.hi.x, 0, plot.hi.y}, {0, 0, -1}, y, {1, 0, 0}},
             {{plot.hi.x, 0, plot.lo.y}, {-1, 0, 0}, y, {0, 0, -1}},
             {{plot.lo.x, 0, plot.lo.y}, {0, 0, 1}, y, {-1, 0, 0}}}};
}

// A tier that stands back is free on all sides.
Plot inset(const Plot& plot, float by) {
    return {plot.lo + by, plot.hi - by, kAllSides};
}

// A wall without windows, towards a neighbour.
void party_wall(MeshBuilder& b, const Wall& w, Finish finish) {
    const float top = w.y0 + w.storey * static_cast<float>(w.floors);
    b.face({{0, w.y0, 0}, {w.width, w.y0, 0}, {w.width, top, 0}, {0, top, 0}}, finish);
}

bool is_rear(const Plot& plot, int side) {
    return (plot.rear & (1u << side)) != 0u;
}

bool is_open(const Plot& plot, int side) {
    return (plot.open & (1u << side)) != 0u;
}

void wall_of(MeshBuilder& b, const CityPalette& p, const Design& d, const Wall& w, Random& random) {
    switch (d.style) {
    case Style::walk_up:
        return punched_wall(b, p, w, d.wall, false, random);
    case Style::apartments:
        return punched_wall(b, p, w, d.wall, true, random);
    case Style::office:
        return ribbon_wall(b, p, w, d.wall, random);
    case Style::glass_tower:
        return curtain_wall(b, p, w, random);
    case Style::setback_tower:
        return pier_wall(b, p, w, d.wall, random);
    }
}

void water_tank(MeshBuilder& b, const CityPalette& p, glm::vec3 at) {
    for (const float x : {-1.0f, 1.0f})
        for (const float z : {-1.0f, 1.0f})
            box(b, at + glm::vec3{x - 0.08f, 0, z - 0.08f},
                at + glm::vec3{x + 0.08f, 2.4f, z + 0.08f}, p.dark_metal, kTop | kBottom);
    b.place.origin = at;
    constexpr std::array<glm::vec2, 6> kTank{
        {{0.0f, 2.4f}, {1.5f, 2.4f}, {1.5f, 5.0f}, {1.65f, 5.0f}, {0.15f, 6.1f}, {0.0f, 6.15f}}};
    revolve(b, kTank, {14, 0.0f, 1.0f, {}}, p.wood);
    b.place = {};
}

void air_conditioner(MeshBuilder& b, const CityPalette& p, glm::vec3 at, float turns) {
    b.place = upright(at, turns);
    box(b, {-1.2f, 0.3f, -0.8f}, {1.2f, 1.6f, 0.8f}, p.metal, kBottom);
    for (const float x : {-1.0f, 0.9f})
        box(b, {x, 0.0f, -0.7f}, {x + 0.1f, 0.3f, 0.7f}, p.dark_metal, kTop | kBottom);
    b.place.origin += glm::vec3{0.0f, 1.6f, 0.0f};
    constexpr std::array<glm::vec2, 3> kFan{{{0.6f, 0.0f}, {0.6f, 0.2f}, {0.0f, 0.12f}}};
    revolve(b, kFan, {10, 0.0f, 1.0f, {}}, p.dark_metal);
    b.place = {};
}

// Gravel within a parapet with a coping.
void flat_roof(MeshBuilder& b, const CityPalette& p, const Plot& plot, float y, Finish wall) {
    constexpr float kHeight = 0.9f, kThickness = 0.35f;
    b.face({{plot.lo.x, y, plot.hi.y},
            {plot.hi.x, y, plot.hi.y},
            {plot.hi.x, y, plot.lo.y},
            {plot.lo.x, y, plot.lo.y}},
           p.gravel);
    const std::array<Placement, 4> frames = side_frames(plot);
    for (std::size_t i = 0; i < 4; ++i) {
        const float width = i % 2 == 0 ? plot.size().x : plot.size().y;
        b.place = frames[i];
        box(b, {0.0f, y, -kThickness}, {width, y + kHeight, 0.0f}, wall, kTop | kLeft | kRight);
        box(b, {-0.06f, y + kHeight, -kThickness - 0.06f},
            {width + 0.06f, y + kHeight + 0.12f, 0.08f}, p.trim);
    }
    b.place = {};
}

void roof_top(MeshBuilder& b, const CityPalette& p, const Plot& plot, float y, Finish wall,
              bool tall, Random& random) {
    flat_roof(b, p, plot, y, wall);
    const Plot inner = inset(plot, 2.6f);
    if (inner.size().x < 3.0f || inner.size().y < 3.0f)
        return;
    const auto somewhere = [&] {
        const float x = random.range(inner.lo.x, inner.hi.x),
                    z = random.range(inner.lo.y, inner.hi.y);
        return glm::vec3{x, y, z};
    };
    const glm::vec3 hut = somewhere();
    box(b, hut - glm::vec3{1.8f, 0.0f, 1.4f}, hut + glm::vec3{1.8f, 2.8f, 1.4f}, wall, kBottom);
    box(b, hut + glm::vec3{-2.0f, 2.8f, -1.6f}, hut + glm::vec3{2.0f, 3.0f, 1.6f}, p.trim);
    const int units = random.between(1, 4);
    for (int i = 0; i < units; ++i) {
        const glm::vec3 at = somewhere();
        air_conditioner(b, p, at, random.chance(0.5f) ? 0.25f : 0.0f);
    }
    if (!tall && random.chance(0.45f))
        water_tank(b, p, somewhere());
    if (tall) {
        const glm::vec3 mast = somewhere();
        const float height = random.range(6.0f, 16.0f);
        const std::array<glm::vec3, 2> pole{mast, mast + glm::vec3{0.0f, height, 0.0f}};
        tube(b, pole, 0.09f, 6, p.metal);
    }
}

// A zigzag of stairs and landings before a wall, as on old tenements.
void fire_escape(MeshBuilder& b, const CityPalette& p, float x, const Wall& w) {
    for (int floor = 0; floor < w.floors; ++floor) {
        const float y = w.y0 + w.storey * static_cast<float>(floor) + 0.1f;
        box(b, {x, y, 0.0f}, {x + 3.6f, y + 0.06f, 1.0f}, p.dark_metal, kBack);
        box(b, {x, y + 0.95f, 0.95f}, {x + 3.6f, y + 1.0f, 1.0f}, p.dark_metal);
        for (int i = 0; i <= 6; ++i) {
            const float bar = x + 0.6f * static_cast<float>(i);
            box(b, {bar - 0.015f, y, 0.96f}, {bar + 0.015f, y + 0.95f, 0.99f}, p.dark_metal,
                kTop | kBottom);
        }
        if (floor + 1 == w.floors)
            continue;
        const float up = y + w.storey, from = floor % 2 == 0 ? x + 0.4f : x + 3.2f,
                    to = floor % 2 == 0 ? x + 3.2f : x + 0.4f;
        for (const float z : {0.25f, 0.75f}) {
            const std::array<glm::vec3, 2> stringer{{{from, y, z}, {to, up, z}}};
            tube(b, stringer, 0.05f, 4, p.dark_metal);
        }
        constexpr int kSteps = 8;
        for (int i = 1; i < kSteps; ++i) {
            const float t = static_cast<float>(i) / kSteps;
            const glm::vec3 at{glm::mix(from, to, t), glm::mix(y, up, t), 0.5f};
            box(b, at - glm::vec3{0.12f, 0.02f, 0.25f}, at + glm::vec3{0.12f, 0.02f, 0.25f},
                p.dark_metal, kLeft | kRight);
        }
    }
}

// Four walls from y0; returns the height of their top.
float tier(MeshBuilder& b, const CityPalette& p, const Design& d, const Plot& plot, float y0,
           int floors, Random& random) {
    const std::array<Placement, 4> frames = side_frames(plot);
    const int escape =
        d.style == Style::walk_up && random.chance(0.55f) ? random.between(0, 3) : -1;
    for (int i = 0; i < 4; ++i) {
        const Wall w{i % 2 == 0 ? plot.size().x : plot.size().y, y0, floors, d.storey};
        b.place = frames[static_cast<std::size_t>(i)];
        if (!is_open(plot, i)) {
            party_wall(b, w, d.wall);
            continue;
        }
        if (is_rear(plot, i))
            rear_wall(b, p, w, d.wall, random);
        else
            wall_of(b, p, d, w, random);
        if (i == escape && w.width > 8.0f)
            fire_escape(b, p, 0.5f * w.width - 1.8f, w);
    }
    b.place = {};
    return y0 + d.storey * static_cast<float>(floors);
}

Design choose_design(const CityPalette& p, float height, Random& random) {
    Design d{Style::walk_up, p.brick[random.below(3)], 3.4f};
    const float pick = random.uniform();
    if (height > 60.0f) {
        d.style = pick < 0.5f ? Style::glass_tower : Style::setback_tower;
        d.wall = pick < 0.75f ? p.stone : p.pale_concrete;
        d.storey = 3.9f;
    } else if (height > 26.0f) {
        d.style = pick < 0.35f  ? Style::office
                  : pick < 0.7f ? Style::apartments
                                : Style::setback_tower;
        if (d.style != Style::apartments || random.chance(0.5f))
            d.wall = random.chance(0.5f) ? p.concrete : p.pale_concrete;
        d.storey = 3.6f;
    } else if (random.chance(0.2f)) {
        d.wall = p.stone;
    }
    return d;
}

} // namespace

void build_building(MeshBuilder& b, const CityPalette& p, const Plot& plot, float height,
                    Random& random) {
    const Design d = choose_design(p, height, random);
    constexpr float kGround = 4.6f;
    const std::array<Placement, 4> frames = side_frames(plot);
    for (int i = 0; i < 4; ++i) {
        b.place = frames[static_cast<std::size_t>(i)];
        const Wall w{i % 2 == 0 ? plot.size().x : plot.size().y, kKerb, 1, kGround - kKerb};
        if (is_open(plot, i) && !is_rear(plot, i))
            shop_front(b, p, w, d.wall, random);
        else
            party_wall(b, w, d.wall);
    }
    b.place = {};
    int floors = std::max(1, static_cast<int>((height - kGround) / d.storey));
    const int tiers = d.style == Style::setback_tower && height > 40.0f ? 3
                      : height > 60.0f                                  ? 2
                                                                        : 1;
    Plot footprint = plot;
    float y = kGround;
    for (int i = 0; i < tiers; ++i) {
        const int part = i + 1 == tiers ? floors : std::max(1, floors * (i == 0 ? 45 : 55) / 100);
        y = tier(b, p, d, footprint, y, part, random);
        floors -= part;
        const bool last = i + 1 == tiers || floors < 1;
        const float step = 0.11f * std::min(footprint.size().x, footprint.size().y);
        if (last) {
            roof_top(b, p, footprint, y, d.wall, height > 60.0f, random);
            break;
        }
        flat_roof(b, p, footprint, y, d.wall);
        footprint = inset(footprint, step);
    }
    if (d.style == Style::setback_tower && height > 90.0f) {
        const glm::vec2 middle = 0.5f * (footprint.lo + footprint.hi);
        b.place = upright({middle.x, y, middle.y});
        constexpr std::array<glm::vec2, 7> kSpire{{{3.4f, 0.0f},
                                                   {3.4f, 4.0f},
                                                   {2.6f, 5.0f},
                                                   {2.4f, 9.0f},
                                                   {0.9f, 14.0f},
                                                   {0.25f, 18.0f},
                                                   {0.0f, 30.0f}}};
        revolve(b, kSpire, {8, 0.0f, 1.0f, {}}, p.metal);
        b.place = {};
    }
}

void build_park(MeshBuilder& b, const CityPalette& p, const Plot& plot, Random& random) {
    const Plot lawn = inset(plot, 1.0f);
    box(b, {lawn.lo.x, kKerb, lawn.lo.y}, {lawn.hi.x, kKerb + 0.12f, lawn.hi.y}, p.lawn, kBottom);
    const int trees = static_cast<int>(plot.size().x * plot.size().y / 70.0f);
    for (int i = 0; i < trees; ++i) {
        const float x = random.range(lawn.lo.x + 2.0f, lawn.hi.x - 2.0f);
        const float z = random.range(lawn.lo.y + 2.0f, lawn.hi.y - 2.0f);
        b.place = upright({x, kKerb + 0.1f, z}, random.uniform());
        street_tree(b, p, random.range(6.0f, 10.0f), random);
    }
    b.place = {};
}

} // namespace macula::scene::procedural
